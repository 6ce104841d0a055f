#include "render/charts/row_chart.h"

#include <algorithm>
#include <cmath>

#include "render/charts/chart.h"

namespace dressform {
namespace {

struct ValueRange {
  double low = 0, high = 0;
  bool any = false;
  void take(double value) {
    if (!std::isfinite(value)) return;
    low = any ? std::min(low, value) : value;
    high = any ? std::max(high, value) : value;
    any = true;
  }
};

Axis axis_of(const RowChart& chart) {
  ValueRange range;
  if (chart.line) range.take(*chart.line - chart.margin), range.take(*chart.line + chart.margin);
  for (const auto& row : chart.rows) {
    for (const auto& dot : row.dots) range.take(dot.value);
    if (row.mean) range.take(*row.mean);
    if (row.interval) range.take(row.interval->low), range.take(row.interval->high);
  }
  if (!range.any) return {chart.axis, 0, 1, false};
  const double width = range.high - range.low;
  const double air = width > 0 ? 0.05 * width : std::max(1.0, std::abs(range.high));
  return {chart.axis, range.low - air, range.high + air, false};
}

// Lengths in millimetres; a row is two letters high.
class RowPainter {
 public:
  RowPainter(const RowChart& chart, const FigureStyle& style)
      : chart_(chart), style_(style), unit_(style.letters_mm / 13), axis_(axis_of(chart)) {
    double names = 0, notes = 0;
    for (const auto& row : chart.rows) {
      names = std::max(names, text_width_mm(row.name, style.letters_mm));
      notes = std::max(notes, text_width_mm(row.note, small()));
    }
    left_ = std::min(names, kMostForNames * style.width_mm) + 24 * unit_;
    right_ = style.width_mm - (notes > 0 ? notes + 24 * unit_ : 20 * unit_);
    top_ = ((style.title_in_figure ? 30 : 8) + (chart.left_word.empty() ? 0 : 22)) * unit_;
    base_ = top_ + kRowUnits * unit_ * static_cast<double>(std::max<std::size_t>(1, chart.rows.size()));
  }

  double height() const {
    const double legend = chart_.legend.empty() ? 0 : 26;
    return base_ + (48 + legend) * unit_;
  }

  void paint(Canvas& canvas) const {
    paint_frame(canvas);
    for (std::size_t i = 0; i < chart_.rows.size(); ++i) paint_row(canvas, i);
    paint_legend(canvas);
  }

 private:
  static constexpr double kRowUnits = 26, kMostForNames = 0.42;
  double small() const { return style_.letters_mm * kSmallerLetters; }
  double x(double value) const {
    return left_ + (right_ - left_) * (value - axis_.minimum) / (axis_.maximum - axis_.minimum);
  }

  void paint_frame(Canvas& canvas) const {
    if (style_.title_in_figure)
      canvas.text({4 * unit_, 20 * unit_}, clipped_text(chart_.title, 15 * unit_, style_.width_mm - 8 * unit_),
                  {15 * unit_});
    if (chart_.line && chart_.margin > 0) {
      const double low = x(*chart_.line - chart_.margin), high = x(*chart_.line + chart_.margin);
      canvas.polygon({{low, top_}, {high, top_}, {high, base_}, {low, base_}}, palette_ink(3, 0.18));
    }
    if (chart_.line)
      canvas.polyline({{x(*chart_.line), top_}, {x(*chart_.line), base_}}, palette_ink(0), style_.hair_mm);
    canvas.polyline({{left_, base_}, {right_, base_}}, palette_ink(0), style_.hair_mm);
    for (const auto& [at, text] : axis_ticks(axis_, right_ - left_ > 300 * unit_ ? 8 : 5)) {
      canvas.polyline({{x(at), base_}, {x(at), base_ + 5 * unit_}}, palette_ink(0), style_.hair_mm);
      canvas.text({x(at), base_ + 18 * unit_}, text, {small(), Lettering::middle});
    }
    canvas.text({0.5 * (left_ + right_), base_ + 38 * unit_}, chart_.axis, {style_.letters_mm, Lettering::middle});
    if (chart_.left_word.empty() || !chart_.line) return;
    const double zero = x(*chart_.line), above = top_ - 8 * unit_;
    canvas.text({zero - 8 * unit_, above}, "← " + chart_.left_word, {small(), Lettering::right});
    canvas.text({zero + 8 * unit_, above}, chart_.right_word + " →", {small()});
  }

  void paint_row(Canvas& canvas, std::size_t place) const {
    const auto& row = chart_.rows[place];
    const double y = top_ + kRowUnits * unit_ * (static_cast<double>(place) + 0.5), base = y + 4.5 * unit_;
    canvas.text({left_ - 12 * unit_, base}, clipped_text(row.name, style_.letters_mm, left_ - 16 * unit_),
                {style_.letters_mm, Lettering::right});
    canvas.polyline({{left_, y}, {right_, y}}, {230, 230, 230, 1}, 0.6 * style_.hair_mm);
    for (const auto& dot : row.dots)
      if (std::isfinite(dot.value))
        canvas.dot({x(dot.value), y}, 3.2 * unit_, palette_ink(dot.color, row.mean ? 0.45 : 1));
    if (row.interval)
      canvas.polyline({{x(row.interval->low), y}, {x(row.interval->high), y}}, palette_ink(0), 1.2 * style_.line_mm);
    if (row.mean && std::isfinite(*row.mean)) canvas.dot({x(*row.mean), y}, 4.5 * unit_, palette_ink(0));
    if (!row.note.empty()) canvas.text({right_ + 10 * unit_, base}, row.note, {small()});
  }

  void paint_legend(Canvas& canvas) const {
    double at = left_;
    const double y = base_ + 58 * unit_;
    for (const auto& [name, color] : chart_.legend) {
      canvas.dot({at + 4 * unit_, y - 4 * unit_}, 3.2 * unit_, palette_ink(color));
      canvas.text({at + 12 * unit_, y}, name, {small()});
      at += text_width_mm(name, small()) + 28 * unit_;
    }
  }

  RowChart chart_;
  FigureStyle style_;
  double unit_;
  Axis axis_;
  double left_ = 0, right_ = 0, top_ = 0, base_ = 0;
};

}  // namespace

Sheet row_chart_sheet(const RowChart& chart, const FigureStyle& style) {
  const RowPainter painter(chart, style);
  return {style.width_mm, painter.height(), chart.title, [painter](Canvas& canvas) { painter.paint(canvas); }};
}

}  // namespace dressform
