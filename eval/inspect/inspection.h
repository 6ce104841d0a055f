#pragma once
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "eval/report/image_tools.h"
#include "render/charts/chart.h"

namespace dressform {

// A measured figure. Judged where `low` or `high` is finite: it is to lie between them.
struct Finding {
  std::string what, unit;
  double measured = 0;
  double reference = std::numeric_limits<double>::quiet_NaN();
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  long samples = 0;  // pixels it was taken from; 0: does not apply

  bool judged() const { return std::isfinite(low) || std::isfinite(high); }
  double shown() const { return std::abs(measured) < 1e-9 ? 0 : measured; }  // without the dust of rounding
  bool good() const { return measured >= low && measured <= high; }
};
// Judged to lie within `part` of the reference.
Finding within(const std::string& what, const std::string& unit, double measured, double reference, double part,
               long samples);

struct InspectionSection {
  std::string title;
  std::vector<std::string> text;
  std::vector<Figure> figures;
  std::vector<Chart> charts;
  std::vector<Finding> findings;
};

// What `dressform inspect` has to say of a session or of a sensor model.
struct Inspection {
  std::string title, summary;
  std::vector<InspectionSection> sections;
};

struct InspectionCount {
  int judged = 0, good = 0, images = 0;
};
InspectionCount count_of(const Inspection& inspection);

// A new folder with inspect.html (self-contained), statistics.json (findings and the points of the charts), a PNG of
// every figure and chart, and an SVG of every chart. Written under a temporary name, then renamed. Throws InputError
// when it is there already.
void write_inspection(const Inspection& inspection, const std::filesystem::path& folder);

}  // namespace dressform
