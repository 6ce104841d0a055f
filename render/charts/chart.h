#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "render/charts/sheet.h"
#include "render/charts/style.h"

namespace dressform {

// A chart as it is meant: what is drawn where, in which units, is the sheet's affair.
struct Axis {
  std::string label;  // with its unit
  double minimum = 0, maximum = 1;
  bool logarithmic = false;  // minimum > 0
};

struct Curve {
  enum Style { line, dashed, dots, dotted_line };
  std::string name;  // in the legend
  Style style = line;
  int color = 0;                        // of palette_ink; 0 is black, for references
  std::vector<Eigen::Vector2d> points;  // parts outside the axes are cut off
};

// What lies between two curves: a tolerance.
struct Band {
  std::string name;
  int color = 0;
  struct Edge {
    double x, low, high;
  };
  std::vector<Edge> edges;
};

// Values with a tolerance at single places.
struct Whiskers {
  std::string name;
  int color = 0;
  struct Mark {
    double x, low, value, high;
  };
  std::vector<Mark> marks;
};

struct Chart {
  std::string name;     // file stem
  std::string title;    // a few words
  std::string caption;  // what is to be seen
  Axis x, y;
  std::vector<Band> bands;
  std::vector<Curve> curves;
  std::vector<Whiskers> whiskers;
};

// A chart without anything in it yet.
Chart empty_chart(const std::string& name, const std::string& title, const std::string& caption, const Axis& x,
                  const Axis& y = {});

// A line through 81 values of a published function: dashed where nobody is judged by it.
template <class Function>
Curve reference_curve(const std::string& name, double from, double to, const Function& value,
                      Curve::Style style = Curve::line) {
  Curve curve{name, style, 0, {}};
  for (int i = 0; i <= 80; ++i) {
    const double x = from + (to - from) * i / 80;
    curve.points.push_back({x, value(x)});
  }
  return curve;
}

// The legend stands to the right where there is room, below the chart in a narrow column.
Sheet chart_sheet(const Chart& chart, const FigureStyle& style = kScreenStyle);
std::string chart_svg(const Chart& chart);
cv::Mat chart_image(const Chart& chart);  // 8-bit BGR, at kScreenDpi

// An axis from 0 (or below, where there are such values) that holds all of the chart's curves, bands and marks.
Axis axis_around(const Chart& chart, const std::string& label);

// Places and texts of an axis's ticks: at most `most` of them on a linear axis; 1, 2 and 5 times powers of ten on a
// logarithmic one.
std::vector<std::pair<double, std::string>> axis_ticks(const Axis& axis, int most);

}  // namespace dressform
