#pragma once
#include <optional>
#include <string>
#include <vector>

#include "render/charts/sheet.h"
#include "render/charts/style.h"

namespace dressform {

// One named row a thing, values along a common axis: forest plots and dots by scene.
struct RowChart {
  struct Dot {
    double value = 0;
    int color = 1;  // of palette_ink
  };
  struct Span {
    double low = 0, high = 0;
  };
  struct Row {
    std::string name;
    std::vector<Dot> dots;         // single values, pale where there is a mean beside them
    std::optional<double> mean;    // a large dot
    std::optional<Span> interval;  // a line through it
    std::string note;              // at the right end: "failed", a verdict
  };
  std::string title, axis;            // the axis's label with its unit
  std::string left_word, right_word;  // what lies on either side of zero: "better", "worse"; empty: no sides
  std::optional<double> line;         // a reference line: 0 for differences, a target
  double margin = 0;                  // shaded to both sides of the line
  std::vector<Row> rows;
  std::vector<std::pair<std::string, int>> legend;  // name, colour
};

Sheet row_chart_sheet(const RowChart& chart, const FigureStyle& style = kScreenStyle);

}  // namespace dressform
