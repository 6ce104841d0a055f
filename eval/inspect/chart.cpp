#include "eval/inspect/chart.h"

#include <algorithm>
#include <cmath>

#include "eval/inspect/canvas.h"
#include "render/ticks.h"

namespace dressform {
namespace {

using Eigen::Vector2d;

constexpr int kWidth = 720, kHeight = 400;
constexpr double kLeft = 72, kRight = 500, kTop = 36, kBottom = 344, kLegend = 520;
constexpr double kLetters = 13;

// Okabe and Ito's colours, which stay apart for the colour-blind.
Ink ink_of(int color, double opacity = 1) {
  static const Ink inks[] = {{40, 40, 40},    {0, 114, 178}, {213, 94, 0},  {0, 158, 115},
                             {204, 121, 167}, {230, 159, 0}, {86, 180, 233}};
  Ink ink = inks[color % 7];
  ink.opacity = opacity;
  return ink;
}

double part_of(const Axis& axis, double value) {
  if (!axis.logarithmic) return (value - axis.minimum) / (axis.maximum - axis.minimum);
  const double low = std::log(axis.minimum), high = std::log(axis.maximum);
  return (std::log(std::max(value, 1e-12)) - low) / (high - low);
}

class ChartPainter {
 public:
  ChartPainter(const Chart& chart, Canvas& canvas) : chart_(chart), canvas_(canvas) {}

  void paint() {
    canvas_.text({kLeft, 22}, chart_.title, 15, Canvas::left);
    for (const auto& band : chart_.bands) paint(band);
    paint_grid();
    for (const auto& curve : chart_.curves) paint(curve);
    for (const auto& whiskers : chart_.whiskers) paint(whiskers);
    canvas_.polyline({{kLeft, kTop}, {kRight, kTop}, {kRight, kBottom}, {kLeft, kBottom}, {kLeft, kTop}}, ink_of(0), 1);
    canvas_.text({0.5 * (kLeft + kRight), kBottom + 42}, chart_.x.label, kLetters, Canvas::middle);
    canvas_.text({22, 0.5 * (kTop + kBottom)}, chart_.y.label, kLetters, Canvas::middle, true);
    paint_legend();
  }

 private:
  double x_at(double x) const { return kLeft + (kRight - kLeft) * part_of(chart_.x, x); }
  double y_at(double y) const { return kBottom - (kBottom - kTop) * part_of(chart_.y, y); }
  Vector2d place(double x, double y) const { return {x_at(x), y_at(y)}; }
  static bool inside(const Vector2d& p) {
    return p.x() >= kLeft - 0.01 && p.x() <= kRight + 0.01 && p.y() >= kTop - 0.01 && p.y() <= kBottom + 0.01;
  }

  static std::vector<std::pair<double, std::string>> ticks(const Axis& axis, int most) {
    std::vector<std::pair<double, std::string>> result;
    if (!axis.logarithmic) {
      const double step = round_step(axis.maximum - axis.minimum, most);
      for (double k = std::ceil(axis.minimum / step - 1e-9); k * step <= axis.maximum + 1e-9 * step; ++k)
        result.push_back({k * step, tick_text(k * step, step)});
      return result;
    }
    for (double power = std::pow(10, std::floor(std::log10(axis.minimum))); power <= axis.maximum; power *= 10)
      for (const double factor : {1.0, 2.0, 5.0})
        if (const double at = factor * power; at >= axis.minimum * (1 - 1e-9) && at <= axis.maximum * (1 + 1e-9))
          result.push_back({at, tick_text(at, power)});
    return result;
  }

  void paint_grid() {
    const Ink grid{222, 222, 222, 1};
    for (const auto& [at, text] : ticks(chart_.x, 10)) {
      canvas_.polyline({{x_at(at), kTop}, {x_at(at), kBottom}}, grid, 0.6);
      canvas_.polyline({{x_at(at), kBottom}, {x_at(at), kBottom + 5}}, ink_of(0), 1);
      canvas_.text({x_at(at), kBottom + 20}, text, kLetters - 1, Canvas::middle);
    }
    for (const auto& [at, text] : ticks(chart_.y, 8)) {
      canvas_.polyline({{kLeft, y_at(at)}, {kRight, y_at(at)}}, grid, 0.6);
      canvas_.polyline({{kLeft - 5, y_at(at)}, {kLeft, y_at(at)}}, ink_of(0), 1);
      canvas_.text({kLeft - 8, y_at(at) + 4.5}, text, kLetters - 1, Canvas::right);
    }
  }

  // Where the line between a point inside and one outside leaves the box.
  static Vector2d cut(const Vector2d& in, const Vector2d& out) {
    double part = 1;
    const Vector2d step = out - in;
    if (step.x() > 0) part = std::min(part, (kRight - in.x()) / step.x());
    if (step.x() < 0) part = std::min(part, (kLeft - in.x()) / step.x());
    if (step.y() > 0) part = std::min(part, (kBottom - in.y()) / step.y());
    if (step.y() < 0) part = std::min(part, (kTop - in.y()) / step.y());
    return in + std::max(0.0, part) * step;
  }

  void paint(const Band& band) {
    const auto clamped = [&](double x, double y) {
      return Vector2d(std::clamp(x_at(x), kLeft, kRight), std::clamp(y_at(y), kTop, kBottom));
    };
    Canvas::Points outline;
    for (const auto& edge : band.edges) outline.push_back(clamped(edge.x, edge.low));
    for (auto edge = band.edges.rbegin(); edge != band.edges.rend(); ++edge)
      outline.push_back(clamped(edge->x, edge->high));
    canvas_.polygon(outline, ink_of(band.color, 0.18));
  }

  void paint(const Curve& curve) {
    const bool dots = curve.style == Curve::dots || curve.style == Curve::dotted_line;
    if (curve.style != Curve::dots) {
      std::vector<Canvas::Points> pieces(1);
      for (std::size_t i = 0; i < curve.points.size(); ++i) {
        const Vector2d here = place(curve.points[i].x(), curve.points[i].y());
        const bool now = inside(here);
        if (i > 0) {
          const Vector2d before = place(curve.points[i - 1].x(), curve.points[i - 1].y());
          if (inside(before) && !now) pieces.back().push_back(cut(before, here)), pieces.emplace_back();
          if (!inside(before) && now) pieces.back().push_back(cut(here, before));
        }
        if (now) pieces.back().push_back(here);
      }
      for (const auto& piece : pieces)
        if (piece.size() > 1)
          canvas_.polyline(piece, ink_of(curve.color), curve.style == Curve::dotted_line ? 1.2 : 1.8,
                           curve.style == Curve::dashed);
    }
    if (!dots) return;
    for (const auto& point : curve.points)
      if (const Vector2d p = place(point.x(), point.y()); inside(p)) canvas_.dot(p, 3.2, ink_of(curve.color));
  }

  void paint(const Whiskers& whiskers) {
    const Ink ink = ink_of(whiskers.color);
    for (const auto& mark : whiskers.marks) {
      const double x = x_at(mark.x), low = std::clamp(y_at(mark.low), kTop, kBottom),
                   high = std::clamp(y_at(mark.high), kTop, kBottom), y = std::clamp(y_at(mark.value), kTop, kBottom);
      canvas_.polyline({{x, low}, {x, high}}, ink, 1.4);
      for (const double end : {low, high}) canvas_.polyline({{x - 5, end}, {x + 5, end}}, ink, 1.4);
      canvas_.polyline({{x - 3.5, y - 3.5}, {x + 3.5, y + 3.5}}, ink, 1.4);
      canvas_.polyline({{x - 3.5, y + 3.5}, {x + 3.5, y - 3.5}}, ink, 1.4);
    }
  }

  void paint_legend() {
    double y = kTop + 12;
    const auto entry = [&](const std::string& name) {
      canvas_.text({kLegend + 34, y + 4.5}, name, kLetters - 1, Canvas::left);
      y += 22;
    };
    for (const auto& curve : chart_.curves) {
      if (curve.name.empty()) continue;
      if (curve.style != Curve::dots)
        canvas_.polyline({{kLegend, y}, {kLegend + 26, y}}, ink_of(curve.color), 1.8, curve.style == Curve::dashed);
      if (curve.style == Curve::dots || curve.style == Curve::dotted_line)
        canvas_.dot({kLegend + 13, y}, 3.2, ink_of(curve.color));
      entry(curve.name);
    }
    for (const auto& band : chart_.bands) {
      if (band.name.empty()) continue;
      canvas_.polygon({{kLegend, y - 6}, {kLegend + 26, y - 6}, {kLegend + 26, y + 6}, {kLegend, y + 6}},
                      ink_of(band.color, 0.18));
      entry(band.name);
    }
    for (const auto& whiskers : chart_.whiskers) {
      if (whiskers.name.empty()) continue;
      const Ink ink = ink_of(whiskers.color);
      canvas_.polyline({{kLegend + 13, y - 8}, {kLegend + 13, y + 8}}, ink, 1.4);
      for (const double end : {y - 8, y + 8}) canvas_.polyline({{kLegend + 8, end}, {kLegend + 18, end}}, ink, 1.4);
      entry(whiskers.name);
    }
  }

  const Chart& chart_;
  Canvas& canvas_;
};

}  // namespace

std::string chart_svg(const Chart& chart) {
  SvgCanvas canvas(kWidth, kHeight);
  ChartPainter(chart, canvas).paint();
  return canvas.svg();
}

cv::Mat chart_image(const Chart& chart) {
  ImageCanvas canvas(kWidth, kHeight);
  ChartPainter(chart, canvas).paint();
  return canvas.image();
}

Chart empty_chart(const std::string& name, const std::string& title, const std::string& caption, const Axis& x,
                  const Axis& y) {
  Chart chart;
  chart.name = name, chart.title = title, chart.caption = caption;
  chart.x = x, chart.y = y;
  return chart;
}

Axis axis_around(const Chart& chart, const std::string& label) {
  double least = 0, most = 0;
  const auto hold = [&](double value) {
    if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
  };
  for (const auto& curve : chart.curves)
    for (const auto& point : curve.points) hold(point.y());
  for (const auto& band : chart.bands)
    for (const auto& edge : band.edges) hold(edge.low), hold(edge.high);
  for (const auto& whiskers : chart.whiskers)
    for (const auto& mark : whiskers.marks) hold(mark.low), hold(mark.high);
  const double step = round_step(std::max(most - least, 1e-6), 8);
  return {label, step * std::floor(least / step), step * std::ceil(most / step + 0.05), false};
}

}  // namespace dressform
