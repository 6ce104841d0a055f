#include "eval/gate/gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "eval/score/targets.h"
#include "pipeline/reconstruct.h"

namespace dressform {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::infinity();  // how far off is what cannot be counted

struct Tolerance {
  double value = 0;
  bool measured = false;
};

Tolerance tolerance_of(const GoldenScore& golden, const MeasuredNuisance& nuisance) {
  if (const auto measured = nuisance.tolerance(golden.row)) return {*measured, true};
  return {golden.tolerance, false};
}

double times_over(double distance, double tolerance) {
  if (distance == 0) return 0;
  return tolerance > 0 ? distance / tolerance : kNoNumber;
}

bool both_numbers(const ScoreRow& a, const ScoreRow& b) {
  return a.status == b.status && std::isfinite(a.value) && std::isfinite(b.value);
}

std::string numbers_text(const GoldenScore& golden, const ScoreRow& now, const Tolerance& tolerance, double times) {
  return fmt::format("reference {:.6g} ({}), new {:.6g} ({}), tolerance {:.3g} {} ({}){}", golden.row.value,
                     golden.row.status, now.value, now.status, tolerance.value, now.unit,
                     tolerance.measured ? "measured" : "declared, not measured",
                     std::isfinite(times) && times > 0 ? fmt::format(", {:.1f} times over", times) : "");
}

// Steps that were accepted one by one: how far past what was accepted knowingly, in tolerances.
double creep_times(const GoldenScore& golden, const ScoreRow& now, double tolerance) {
  if (!both_numbers(golden.row, now) || !std::isfinite(golden.first)) return 0;
  const double before = worsening(now, golden.first, golden.row.value), drift = worsening(now, golden.first, now.value);
  const bool went_on = before > 0 && worsening(now, golden.row.value, now.value) > 0;
  return went_on && tolerance > 0 ? (drift - golden.known_drift) / tolerance : 0;
}

GateItem compared_number(const GoldenScore& golden, const ScoreRow* now, const Tolerance& tolerance) {
  GateItem item{golden.row.stage, golden.row.metric, ItemVerdict::same, "", 0};
  if (!now) return {item.stage, item.name, ItemVerdict::gone, "no longer measured", kNoNumber};
  if (!both_numbers(golden.row, *now)) {
    const bool same = golden.row.status == now->status && std::isfinite(golden.row.value) == std::isfinite(now->value);
    if (same) return item;
    item.verdict = golden.row.status == "failed" && now->status == "ok" ? ItemVerdict::better : ItemVerdict::worse;
    item.times = kNoNumber;
    item.message = numbers_text(golden, *now, tolerance, 0);
    return item;
  }
  const double distance = std::abs(now->value - golden.row.value), creep = creep_times(golden, *now, tolerance.value);
  item.times = times_over(distance, tolerance.value);
  item.message = distance == 0 ? "" : numbers_text(golden, *now, tolerance, item.times);
  if (item.times > 1)
    item.verdict = worsening(*now, golden.row.value, now->value) < 0 ? ItemVerdict::better : ItemVerdict::worse;
  else if (distance > 0)
    item.verdict = ItemVerdict::within;
  if (item.verdict != ItemVerdict::worse && creep > kCreepTolerances) {
    item.verdict = ItemVerdict::creep;
    item.times = creep;
    item.message =
        fmt::format("was {:.6g} when first accepted, {:.6g} now: {:.1f} tolerances of {:.3g} {} in small steps",
                    golden.first, now->value, creep, tolerance.value, now->unit);
  }
  return item;
}

void compare_scores(const GoldenCase& golden, const GoldenRun& run, const MeasuredNuisance& nuisance,
                    GateResult& result) {
  std::set<std::string> unmeasured;
  for (const auto& reference : golden.scores) {
    const Tolerance tolerance = tolerance_of(reference, nuisance);
    const Metric* metric = find_metric(reference.row.stage, reference.row.metric);
    if (!tolerance.measured && metric && reference.row.status == "ok")
      unmeasured.insert(reference.row.stage + " " + metric->name);
    result.items.push_back(
        compared_number(reference, run.scores.find(reference.row.stage, reference.row.metric), tolerance));
    ++result.compared;
  }
  result.unmeasured.assign(unmeasured.begin(), unmeasured.end());
}

void compare_targets(const GoldenCase& golden, const Scores& scores, GateResult& result) {
  for (const auto& each : target_results(scores)) {
    const auto known = golden.known_misses.find(each.name());
    const bool is_known = known != golden.known_misses.end();
    result.targets.push_back({each.name(), each.value_text(), each.metric->target_text(), each.metric->from_scale,
                              each.met, !each.met && is_known ? known->second : ""});
    GateItem item{each.row->stage, each.row->metric + " (target)", ItemVerdict::same, "", kNoNumber};
    if (!each.met && !is_known) {
      item.verdict = ItemVerdict::worse;
      item.message = fmt::format("newly missed: {}, target {}", each.value_text(), each.metric->target_text());
    } else if (each.met && is_known) {
      item.verdict = ItemVerdict::better;
      item.message = fmt::format("is met now: {}, target {}; known as missed: {}", each.value_text(),
                                 each.metric->target_text(), known->second);
    }
    result.items.push_back(item);
  }
}

void compare_images(const GoldenCase& golden, const GoldenRun& run, const PictureTolerance& tolerance,
                    GateResult& result) {
  for (const auto& [stem, reference] : golden.images) {
    ++result.compared;
    const auto now = run.images.find(stem);
    if (now == run.images.end()) {
      result.items.push_back({"image", stem, ItemVerdict::gone, "no longer made", kNoNumber});
      continue;
    }
    const PictureDifference difference = picture_difference(reference, now->second);
    const double times = tolerance.excess(difference);
    result.items.push_back(
        {"image", stem,
         times == 0  ? ItemVerdict::same
         : times > 1 ? ItemVerdict::worse
                     : ItemVerdict::within,
         times == 0
             ? ""
             : fmt::format("{}; tolerance {:.2f}, {:.2f}, {:.4f}, {:.4f} ({})", picture_text(difference),
                           tolerance.mean_levels, tolerance.worst_tile_levels, tolerance.flip,
                           tolerance.worst_tile_flip, tolerance.measured ? "measured" : "declared, not measured"),
         times});
  }
}

bool knows(const GoldenCase& golden, const ScoreRow& row) {
  return std::any_of(golden.scores.begin(), golden.scores.end(), [&](const GoldenScore& each) {
    return each.row.stage == row.stage && each.row.metric == row.metric;
  });
}

void find_unknown(const GoldenCase& golden, const GoldenRun& run, GateResult& result) {
  for (const auto& row : run.scores.rows)
    if (!knows(golden, row))
      result.items.push_back(
          {row.stage, row.metric, ItemVerdict::unknown, "not in the reference: obsolete", kNoNumber});
  for (const auto& [stem, image] : run.images)
    if (!golden.images.count(stem))
      result.items.push_back({"image", stem, ItemVerdict::unknown, "not in the reference: obsolete", kNoNumber});
}

int badness(ItemVerdict verdict) {
  switch (verdict) {
    case ItemVerdict::same:
      return 0;
    case ItemVerdict::within:
      return 1;
    case ItemVerdict::better:
      return 2;
    case ItemVerdict::unknown:
      return 3;
    case ItemVerdict::creep:
      return 4;
    case ItemVerdict::gone:
    case ItemVerdict::worse:
      break;
  }
  return 5;
}

// Stages in the order in which they come first among the items, the worst first.
std::vector<StageVerdict> stage_verdicts(const std::vector<GateItem>& items) {
  std::vector<StageVerdict> stages;
  for (const auto& item : items) {
    auto found = std::find_if(stages.begin(), stages.end(), [&](const auto& each) { return each.stage == item.stage; });
    if (found == stages.end()) found = stages.insert(stages.end(), StageVerdict{item.stage, ItemVerdict::same, 0, {}});
    ++found->counts[item.verdict];
    if (badness(item.verdict) > badness(found->verdict)) found->verdict = item.verdict;
    if (is_failure(item.verdict)) found->times = std::max(found->times, item.times);
  }
  std::stable_sort(stages.begin(), stages.end(), [](const StageVerdict& a, const StageVerdict& b) {
    if (badness(a.verdict) != badness(b.verdict)) return badness(a.verdict) > badness(b.verdict);
    return a.times > b.times;
  });
  return stages;
}

}  // namespace

const char* verdict_word(ItemVerdict verdict) {
  switch (verdict) {
    case ItemVerdict::same:
      return "identical";
    case ItemVerdict::within:
      return "within nuisance";
    case ItemVerdict::better:
      return "better";
    case ItemVerdict::worse:
      return "worse";
    case ItemVerdict::creep:
      return "creep";
    case ItemVerdict::gone:
      return "gone";
    case ItemVerdict::unknown:
      break;
  }
  return "unknown";
}

bool is_failure(ItemVerdict verdict) { return badness(verdict) >= badness(ItemVerdict::unknown); }

std::string first_failing_stage(const std::vector<GateItem>& findings) {
  const auto stages = describe_stages();
  const auto rank = [&](const std::string& stage) {
    return std::find_if(stages.begin(), stages.end(), [&](const auto& each) { return each.name == stage; }) -
           stages.begin();
  };
  const auto first = std::min_element(findings.begin(), findings.end(), [&](const GateItem& a, const GateItem& b) {
    return rank(a.stage) < rank(b.stage);
  });
  return first == findings.end() ? std::string() : first->stage;
}

GateResult compare_with_golden(const GoldenCase& golden, const GoldenRun& run, const MeasuredNuisance& nuisance) {
  GateResult result;
  result.bytes = compare_bytes(golden.steps, golden.environment, run.steps, run.environment);
  compare_scores(golden, run, nuisance, result);
  compare_targets(golden, run.scores, result);
  compare_images(golden, run, nuisance.picture_tolerance(), result);
  find_unknown(golden, run, result);
  for (const auto& item : result.items) {
    if (is_failure(item.verdict)) result.findings.push_back(item);
    if (item.verdict == ItemVerdict::better) result.better.push_back(item);
    if (item.verdict == ItemVerdict::unknown && result.verdict == GateVerdict::pass)
      result.verdict = GateVerdict::obsolete;
    else if (is_failure(item.verdict) && item.verdict != ItemVerdict::unknown)
      result.verdict = GateVerdict::regression;
  }
  for (auto* list : {&result.findings, &result.better})
    std::stable_sort(list->begin(), list->end(),
                     [](const GateItem& a, const GateItem& b) { return a.times > b.times; });
  result.stages = stage_verdicts(result.items);
  result.blame =
      result.bytes.state == BytesState::changed ? result.bytes.origins.front() : first_failing_stage(result.findings);
  return result;
}

double nuisance_tolerance(const ScoreRow& row) {
  const Metric* metric = find_metric(row.stage, row.metric);
  if (!metric) throw std::logic_error("no metric declares " + row.stage + " " + row.metric);
  if (!std::isfinite(row.value)) return 0;  // what was not measured is compared by its status
  return metric->nuisance().tolerance(row.value);
}

double worsening(const ScoreRow& row, double from, double to) {
  const Metric* metric = find_metric(row.stage, row.metric);
  switch (metric ? metric->better : Better::neither) {
    case Better::lower:
      return to - from;
    case Better::higher:
      return from - to;
    case Better::near_zero:
      return std::abs(to) - std::abs(from);
    case Better::neither:
      break;
  }
  return std::abs(to - from);
}

}  // namespace dressform
