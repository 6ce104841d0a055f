#include "render/charts/chart.h"

#include <algorithm>
#include <cmath>

#include "render/ticks.h"

namespace dressform {
namespace {

using Eigen::Vector2d;

double part_of(const Axis& axis, double value) {
  if (!axis.logarithmic) return (value - axis.minimum) / (axis.maximum - axis.minimum);
  const double low = std::log(axis.minimum), high = std::log(axis.maximum);
  return (std::log(std::max(value, 1e-12)) - low) / (high - low);
}

// What the legend lists, in its order.
struct LegendEntry {
  std::string name;
  const Curve* curve = nullptr;
  const Band* band = nullptr;
  const Whiskers* whiskers = nullptr;
};

std::vector<LegendEntry> legend_of(const Chart& chart) {
  std::vector<LegendEntry> entries;
  for (const auto& curve : chart.curves)
    if (!curve.name.empty()) entries.push_back({curve.name, &curve, nullptr, nullptr});
  for (const auto& band : chart.bands)
    if (!band.name.empty()) entries.push_back({band.name, nullptr, &band, nullptr});
  for (const auto& whiskers : chart.whiskers)
    if (!whiskers.name.empty()) entries.push_back({whiskers.name, nullptr, nullptr, &whiskers});
  return entries;
}

// Where things stand, millimetres. Distances go with the size of the letters, of which one is 13 of `unit`.
struct ChartLayout {
  double unit, width, height, left, right, top, bottom, legend_x, legend_y, legend_step;

  ChartLayout(const Chart& chart, const FigureStyle& style) {
    unit = style.letters_mm / 13;
    width = style.width_mm;
    double widest = 0;
    const auto entries = legend_of(chart);
    for (const auto& entry : entries)
      widest = std::max(widest, text_width_mm(entry.name, style.letters_mm * kSmallerLetters));
    left = 72 * unit;
    top = (style.title_in_figure ? 36 : 12) * unit;
    bottom = style.chart_part * width - 56 * unit;
    legend_step = 22 * unit;
    const double beside = entries.empty() ? 0 : widest + 58 * unit;
    constexpr double kMostOfTheWidth = 0.40;  // for the legend; beyond it the plot would be a strip
    const bool below = beside > kMostOfTheWidth * width;
    right = width - (below || entries.empty() ? 16 * unit : beside);
    legend_x = below ? left : right + 20 * unit;
    legend_y = below ? bottom + 66 * unit : top + 12 * unit;
    height = bottom + 56 * unit + (below ? legend_step * static_cast<double>(entries.size()) + 4 * unit : 0);
  }
};

class ChartPainter {
 public:
  ChartPainter(const Chart& chart, const FigureStyle& style, Canvas& canvas)
      : chart_(chart), style_(style), at_(chart, style), canvas_(canvas) {}

  void paint() {
    const double unit = at_.unit;
    if (style_.title_in_figure) {
      const double size = 15 * unit;
      canvas_.text({at_.left, 22 * unit}, clipped_text(chart_.title, size, at_.width - at_.left), {size});
    }
    for (const auto& band : chart_.bands) paint(band);
    paint_grid();
    for (const auto& curve : chart_.curves) paint(curve);
    for (const auto& whiskers : chart_.whiskers) paint(whiskers);
    canvas_.rectangle({at_.left, at_.top}, {at_.right - at_.left, at_.bottom - at_.top}, palette_ink(0),
                      style_.hair_mm);
    canvas_.text({0.5 * (at_.left + at_.right), at_.bottom + 42 * unit}, chart_.x.label,
                 {style_.letters_mm, Lettering::middle});
    canvas_.text({22 * unit, 0.5 * (at_.top + at_.bottom)}, chart_.y.label,
                 {style_.letters_mm, Lettering::middle, true});
    paint_legend();
  }

 private:
  double x_at(double x) const { return at_.left + (at_.right - at_.left) * part_of(chart_.x, x); }
  double y_at(double y) const { return at_.bottom - (at_.bottom - at_.top) * part_of(chart_.y, y); }
  Vector2d place(double x, double y) const { return {x_at(x), y_at(y)}; }
  bool inside(const Vector2d& p) const {
    constexpr double kRounding = 1e-3;
    return p.x() >= at_.left - kRounding && p.x() <= at_.right + kRounding && p.y() >= at_.top - kRounding &&
           p.y() <= at_.bottom + kRounding;
  }
  double smaller() const { return style_.letters_mm * kSmallerLetters; }

  void paint_grid() {
    const Ink grid{222, 222, 222, 1};
    const double unit = at_.unit;
    for (const auto& [at, text] : axis_ticks(chart_.x, (at_.right - at_.left) > 300 * unit ? 10 : 6)) {
      canvas_.polyline({{x_at(at), at_.top}, {x_at(at), at_.bottom}}, grid, 0.6 * style_.hair_mm);
      canvas_.polyline({{x_at(at), at_.bottom}, {x_at(at), at_.bottom + 5 * unit}}, palette_ink(0), style_.hair_mm);
      canvas_.text({x_at(at), at_.bottom + 20 * unit}, text, {smaller(), Lettering::middle});
    }
    for (const auto& [at, text] : axis_ticks(chart_.y, 8)) {
      canvas_.polyline({{at_.left, y_at(at)}, {at_.right, y_at(at)}}, grid, 0.6 * style_.hair_mm);
      canvas_.polyline({{at_.left - 5 * unit, y_at(at)}, {at_.left, y_at(at)}}, palette_ink(0), style_.hair_mm);
      canvas_.text({at_.left - 8 * unit, y_at(at) + 4.5 * unit}, text, {smaller(), Lettering::right});
    }
  }

  // Where the line between a point inside and one outside leaves the box.
  Vector2d cut(const Vector2d& in, const Vector2d& out) const {
    double part = 1;
    const Vector2d step = out - in;
    if (step.x() > 0) part = std::min(part, (at_.right - in.x()) / step.x());
    if (step.x() < 0) part = std::min(part, (at_.left - in.x()) / step.x());
    if (step.y() > 0) part = std::min(part, (at_.bottom - in.y()) / step.y());
    if (step.y() < 0) part = std::min(part, (at_.top - in.y()) / step.y());
    return in + std::max(0.0, part) * step;
  }

  void paint(const Band& band) {
    const auto clamped = [&](double x, double y) {
      return Vector2d(std::clamp(x_at(x), at_.left, at_.right), std::clamp(y_at(y), at_.top, at_.bottom));
    };
    Canvas::Points outline;
    for (const auto& edge : band.edges) outline.push_back(clamped(edge.x, edge.low));
    for (auto edge = band.edges.rbegin(); edge != band.edges.rend(); ++edge)
      outline.push_back(clamped(edge->x, edge->high));
    canvas_.polygon(outline, palette_ink(band.color, 0.18));
  }

  // The parts of a curve that lie in the box.
  std::vector<Canvas::Points> pieces_of(const Curve& curve) const {
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
    return pieces;
  }

  void paint(const Curve& curve) {
    const bool dots = curve.style == Curve::dots || curve.style == Curve::dotted_line;
    if (curve.style != Curve::dots)
      for (const auto& piece : pieces_of(curve))
        if (piece.size() > 1)
          canvas_.polyline(piece, palette_ink(curve.color),
                           curve.style == Curve::dotted_line ? 0.67 * style_.line_mm : style_.line_mm,
                           curve.style == Curve::dashed);
    if (!dots) return;
    for (const auto& point : curve.points)
      if (const Vector2d p = place(point.x(), point.y()); inside(p))
        canvas_.dot(p, 3.2 * at_.unit, palette_ink(curve.color));
  }

  void paint(const Whiskers& whiskers) {
    const Ink ink = palette_ink(whiskers.color);
    const double end_mm = 5 * at_.unit, cross = 3.5 * at_.unit, width = 0.78 * style_.line_mm;
    for (const auto& mark : whiskers.marks) {
      const double x = x_at(mark.x);
      const auto held = [&](double y) { return std::clamp(y_at(y), at_.top, at_.bottom); };
      const double low = held(mark.low), high = held(mark.high), y = held(mark.value);
      canvas_.polyline({{x, low}, {x, high}}, ink, width);
      for (const double end : {low, high}) canvas_.polyline({{x - end_mm, end}, {x + end_mm, end}}, ink, width);
      canvas_.polyline({{x - cross, y - cross}, {x + cross, y + cross}}, ink, width);
      canvas_.polyline({{x - cross, y + cross}, {x + cross, y - cross}}, ink, width);
    }
  }

  void paint_sign(const LegendEntry& entry, double y) {
    const double unit = at_.unit, x = at_.legend_x, end = x + 26 * unit, middle = x + 13 * unit;
    if (entry.curve) {
      const auto style = entry.curve->style;
      const Ink ink = palette_ink(entry.curve->color);
      if (style != Curve::dots) canvas_.polyline({{x, y}, {end, y}}, ink, style_.line_mm, style == Curve::dashed);
      if (style == Curve::dots || style == Curve::dotted_line) canvas_.dot({middle, y}, 3.2 * unit, ink);
    } else if (entry.band) {
      const double half = 6 * unit;
      canvas_.polygon({{x, y - half}, {end, y - half}, {end, y + half}, {x, y + half}},
                      palette_ink(entry.band->color, 0.18));
    } else {
      const Ink ink = palette_ink(entry.whiskers->color);
      const double half = 8 * unit, width = 0.78 * style_.line_mm;
      canvas_.polyline({{middle, y - half}, {middle, y + half}}, ink, width);
      for (const double tip : {y - half, y + half})
        canvas_.polyline({{middle - 5 * unit, tip}, {middle + 5 * unit, tip}}, ink, width);
    }
  }

  void paint_legend() {
    double y = at_.legend_y;
    for (const auto& entry : legend_of(chart_)) {
      paint_sign(entry, y);
      canvas_.text({at_.legend_x + 34 * at_.unit, y + 4.5 * at_.unit}, entry.name, {smaller()});
      y += at_.legend_step;
    }
  }

  const Chart& chart_;
  const FigureStyle& style_;
  ChartLayout at_;
  Canvas& canvas_;
};

}  // namespace

std::vector<std::pair<double, std::string>> axis_ticks(const Axis& axis, int most) {
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

Sheet chart_sheet(const Chart& chart, const FigureStyle& style) {
  const ChartLayout layout(chart, style);
  return {layout.width, layout.height, chart.title,
          [chart, style](Canvas& canvas) { ChartPainter(chart, style, canvas).paint(); }};
}

std::string chart_svg(const Chart& chart) { return sheet_svg(chart_sheet(chart)); }

cv::Mat chart_image(const Chart& chart) { return sheet_image(chart_sheet(chart), kScreenDpi); }

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
