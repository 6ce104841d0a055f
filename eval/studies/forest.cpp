#include "eval/studies/forest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eval/inspect/canvas.h"
#include "render/ticks.h"

namespace dressform {
namespace {

constexpr double kNames = 250, kPlot = 520, kSide = 24, kRow = 26, kTop = 30, kBottom = 44;
constexpr double kLetter = 12;
constexpr int kMostParts = 6;  // between ticks
const Ink kBlack{30, 30, 30, 1}, kGrey{150, 150, 150, 1}, kScene{70, 110, 160, 0.45}, kMargin{120, 170, 120, 0.18};

struct Range {
  double low = 0, high = 0;
  void take(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

Range range_of(const std::vector<VariantSummary>& summaries, std::size_t metric, double margin) {
  Range range;
  range.take(margin);
  range.take(-margin);
  for (const auto& summary : summaries) {
    const Comparison& comparison = summary.comparisons[metric];
    for (const auto& difference : comparison.differences) range.take(difference.value);
    if (comparison.interval) range.take(comparison.interval->low), range.take(comparison.interval->high);
  }
  if (range.high - range.low <= 0) return {-1, 1};
  const double air = 0.05 * (range.high - range.low);
  return {range.low - air, range.high + air};
}

class Forest {
 public:
  Forest(const Range& range, std::size_t rows)
      : range_(range),
        height_(kTop + kRow * static_cast<double>(rows) + kBottom),
        canvas_(static_cast<int>(kNames + kPlot + 2 * kSide), static_cast<int>(height_)) {}

  void frame(const StudyMetric& metric) {
    const double base = height_ - kBottom;
    if (metric.margin > 0)
      canvas_.polygon(
          {{x(-metric.margin), kTop}, {x(metric.margin), kTop}, {x(metric.margin), base}, {x(-metric.margin), base}},
          kMargin);
    canvas_.polyline({{x(0), kTop}, {x(0), base}}, kGrey, 1, false);
    canvas_.polyline({{x(range_.low), base}, {x(range_.high), base}}, kBlack, 1, false);
    const double step = round_step(range_.high - range_.low, kMostParts);
    for (double at = std::ceil(range_.low / step) * step; at <= range_.high; at += step) {
      canvas_.polyline({{x(at), base}, {x(at), base + 4}}, kBlack, 1, false);
      canvas_.text({x(at), base + 17}, fmt::format("{:g}", std::abs(at) < 1e-9 * step ? 0 : at), 11, Canvas::middle,
                   false);
    }
    const bool bare = metric.metric->unit == "1";
    canvas_.text({kNames + kSide + 0.5 * kPlot, height_ - 8},
                 "difference from the baseline" + (bare ? "" : ", " + metric.metric->unit), kLetter, Canvas::middle,
                 false);
    canvas_.text({kNames + kSide + 0.5 * kPlot, 16},
                 metric.metric->better == Better::higher ? "worse <   > better" : "better <   > worse", kLetter,
                 Canvas::middle, false);
  }

  void row(std::size_t place, const std::string& name, const Comparison& comparison) {
    const double y = kTop + kRow * (static_cast<double>(place) + 0.5);
    canvas_.text({kNames, y + 4}, name, kLetter, Canvas::right, false);
    for (const auto& difference : comparison.differences) canvas_.dot({x(difference.value), y}, 3, kScene);
    if (comparison.interval)
      canvas_.polyline({{x(comparison.interval->low), y}, {x(comparison.interval->high), y}}, kBlack, 2, false);
    if (comparison.pairs() > 0) canvas_.dot({x(comparison.effect), y}, 4.5, kBlack);
  }

  std::string svg() const { return canvas_.svg(); }

 private:
  double x(double value) const { return kNames + kSide + kPlot * (value - range_.low) / (range_.high - range_.low); }
  Range range_;
  double height_;
  SvgCanvas canvas_;
};

}  // namespace

std::string forest_svg(const StudyResults& results, const std::vector<VariantSummary>& summaries, std::size_t metric) {
  const StudyMetric& asked = results.plan.study.metrics[metric];
  const std::vector<VariantSummary> others(summaries.begin() + 1, summaries.end());
  Forest forest(range_of(others, metric, asked.margin), others.size());
  forest.frame(asked);
  for (std::size_t place = 0; place < others.size(); ++place)
    forest.row(place, results.plan.study.variants[others[place].variant].name, others[place].comparisons[metric]);
  return forest.svg();
}

}  // namespace dressform
