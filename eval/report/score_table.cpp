#include "eval/report/score_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

enum class Bound { none, at_most, at_least, magnitude_at_most };

// A measure of the first table. "*" in `metric` stands for the slot: a line for each garment.
struct Measure {
  const char* stage;
  const char* metric;
  const char* name;
  Bound bound;
  double limit;
};

constexpr Measure kMeasures[] = {
    {"registration", "max/rotation_deg@1", "worst rotation", Bound::at_most, 0.5},
    {"registration", "max/tre_mm@1", "worst target error", Bound::at_most, 4},
    {"fuse", "naked_body/accuracy_median_mm@1", "mannequin, median", Bound::none, 0},
    {"fuse", "user_body/accuracy_median_mm@1", "user, median", Bound::none, 0},
    {"segment", "mean/iou_top@1", "IoU top", Bound::none, 0},
    {"segment", "mean/iou_bottom@1", "IoU bottom", Bound::none, 0},
    {"surface", "*/f_5mm@1", "F at 5 mm", Bound::at_least, 0.85},
    {"surface", "*/f_10mm@1", "F at 10 mm", Bound::at_least, 0.93},
    {"surface", "*/accuracy_median_mm@1", "median accuracy", Bound::at_most, 2.5},
    {"surface", "*/completeness_median_mm@1", "median completeness", Bound::none, 0},
    {"open", "*/loops@1", "openings", Bound::none, 0},
    {"open", "*/loop_difference@1", "openings too many or few", Bound::at_most, 0},
    {"open", "*/boundary_identity@1", "B - (2V - F - 2 chi)", Bound::magnitude_at_most, 0},
    {"open", "*/rims_hd95_mm@1", "worst rim HD95", Bound::at_most, 25},
    {"texture", "*/ssim_observed@2", "SSIM, held-out views", Bound::at_least, 0.75},
    {"texture", "*/ssim@2", "SSIM with unseen cloth", Bound::none, 0},
    {"texture", "*/de2000_mean@2", "CIEDE2000, held-out views", Bound::none, 0},
    {"fit", "*/ease_chest_change_mm@3", "ease change, chest", Bound::magnitude_at_most, 15},
    {"fit", "*/ease_waist_change_mm@3", "ease change, waist", Bound::magnitude_at_most, 15},
    {"fit", "*/ease_hip_change_mm@3", "ease change, hip", Bound::magnitude_at_most, 15},
    {"fit", "*/edge_stretch_p95@1", "edge stretch p95", Bound::none, 0},
    {"correct", "*/intersecting_pairs@1", "triangles through the body", Bound::at_most, 0},
};

bool met(const Measure& measure, double value) {
  switch (measure.bound) {
    case Bound::at_most:
      return value <= measure.limit;
    case Bound::at_least:
      return value >= measure.limit;
    case Bound::magnitude_at_most:
      return std::abs(value) <= measure.limit;
    case Bound::none:
      return true;
  }
  return false;
}

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit == "1" || unit == "count" ? number : number + " " + unit;
}

std::string number_text(double value, const std::string& unit) {
  if (unit == "count") return fmt::format("{:.0f}", value);
  return fmt::format(unit == "1" || unit == "deg" ? fmt::runtime("{:.3f}") : fmt::runtime("{:.2f}"), value);
}

ScoreLine line_of(const Measure& measure, const ScoreRow& row, const std::string& part) {
  ScoreLine line{part, measure.name, row.status, {}, ScoreLine::State::plain};
  if (row.status == "ok") line.value = with_unit(number_text(row.value, row.unit), row.unit);
  if (measure.bound == Bound::none || row.status == "absent") return line;
  const char* relation = measure.bound == Bound::at_least ? ">=" : measure.bound == Bound::at_most ? "<=" : "within +-";
  line.target = with_unit(fmt::format("{} {:g}", relation, measure.limit), row.unit);
  line.state = row.status == "ok" && met(measure, row.value) ? ScoreLine::State::met : ScoreLine::State::missed;
  return line;
}

}  // namespace

std::vector<ScoreLine> score_lines(const Scores& scores) {
  std::vector<ScoreLine> lines;
  for (const auto& measure : kMeasures) {
    const std::string metric = measure.metric;
    if (metric.front() != '*') {
      if (const auto* row = scores.find(measure.stage, metric)) lines.push_back(line_of(measure, *row, measure.stage));
      continue;
    }
    for (const char* slot : {"top", "bottom"})
      if (const auto* row = scores.find(measure.stage, slot + metric.substr(1)))
        lines.push_back(line_of(measure, *row, slot));
  }
  // Registration and bodies first, then all of the top, then all of the bottom.
  const auto rank = [](const ScoreLine& line) { return line.part == "bottom" ? 2 : line.part == "top" ? 1 : 0; };
  std::stable_sort(lines.begin(), lines.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return lines;
}

std::string score_table_text(const Scores& scores) {
  std::string text = fmt::format("scores of {} (seed {}, {})\n", scores.scene, scores.seed, scores.variant);
  int judged = 0, missed = 0;
  for (const auto& line : score_lines(scores)) {
    judged += line.judged();
    missed += line.missed();
    text += fmt::format("  {:<13} {:<27} {:>12}  {:<14} {}\n", line.part, line.measure, line.value, line.target,
                        line.missed() ? "MISSED" : "");
  }
  return text + fmt::format("{} of {} targets met", judged - missed, judged);
}

}  // namespace dressform
