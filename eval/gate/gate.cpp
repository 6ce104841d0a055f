#include "eval/gate/gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "eval/score/targets.h"
#include "scenes/error.h"

namespace dressform {
namespace {

// Mean absolute difference in 8-bit levels that images may show: anti-aliased edges and dithering of texture
// filtering differ between instruction sets, surfaces do not.
constexpr double kImageTolerance = 1.0;

bool within(const GoldenScore& golden, const ScoreRow& now) {
  if (golden.row.status != now.status) return false;
  if (!std::isfinite(golden.row.value) || !std::isfinite(now.value))
    return std::isfinite(golden.row.value) == std::isfinite(now.value);
  return std::abs(golden.row.value - now.value) <= golden.tolerance;
}

// Whether a number beyond tolerance changed for the better, by the direction that its metric declares.
bool is_better(const GoldenScore& golden, const ScoreRow& now) {
  if (now.status != "ok") return false;
  if (golden.row.status == "failed") return true;
  const Metric* metric = find_metric(now.stage, now.metric);
  if (!metric || golden.row.status != "ok") return false;
  switch (metric->better) {
    case Better::lower:
      return now.value < golden.row.value;
    case Better::higher:
      return now.value > golden.row.value;
    case Better::near_zero:
      return std::abs(now.value) < std::abs(golden.row.value);
    case Better::neither:
      break;
  }
  return false;
}

double image_difference(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return 255;
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  const cv::Scalar mean = cv::mean(difference);
  return (mean[0] + mean[1] + mean[2]) / 3;
}

std::string name_of(const ScoreRow& row) { return row.stage + " " + row.metric; }

void compare_scores(const GoldenCase& golden, const Scores& scores, GateResult& result) {
  for (const auto& reference : golden.scores) {
    ++result.compared;
    const std::string what = name_of(reference.row);
    const ScoreRow* now = scores.find(reference.row.stage, reference.row.metric);
    if (!now) {
      result.findings.push_back({what, "no longer measured"});
    } else if (!within(reference, *now)) {
      auto& place = is_better(reference, *now) ? result.better : result.findings;
      place.push_back(
          {what, fmt::format("reference {:.6g} ({}), new {:.6g} ({}), tolerance {:.3g} {}", reference.row.value,
                             reference.row.status, now->value, now->status, reference.tolerance, now->unit)});
    }
  }
}

void compare_targets(const GoldenCase& golden, const Scores& scores, GateResult& result) {
  for (const auto& each : target_results(scores)) {
    const auto known = golden.known_misses.find(each.name());
    const bool is_known = known != golden.known_misses.end();
    result.targets.push_back({each.name(), each.value_text(), each.metric->target_text(), each.metric->from_scale,
                              each.met, !each.met && is_known ? known->second : ""});
    if (!each.met && !is_known)
      result.findings.push_back({"target " + each.name(), fmt::format("newly missed: {}, target {}", each.value_text(),
                                                                      each.metric->target_text())});
    if (each.met && is_known)
      result.better.push_back(
          {"target " + each.name(), fmt::format("is met now: {}, target {}; known as missed: {}", each.value_text(),
                                                each.metric->target_text(), known->second)});
  }
}

void compare_images(const GoldenCase& golden, const std::map<std::string, cv::Mat>& images, GateResult& result) {
  for (const auto& [stem, reference] : golden.images) {
    ++result.compared;
    const auto now = images.find(stem);
    if (now == images.end()) {
      result.findings.push_back({"image " + stem, "no longer made"});
      continue;
    }
    const double difference = image_difference(reference, now->second);
    if (difference > kImageTolerance)
      result.findings.push_back({"image " + stem, fmt::format("mean difference {:.2f} levels, tolerance {:.2f}",
                                                              difference, kImageTolerance)});
  }
}

const GoldenScore* find(const GoldenCase& golden, const ScoreRow& row) {
  const auto found = std::find_if(golden.scores.begin(), golden.scores.end(), [&](const GoldenScore& each) {
    return each.row.stage == row.stage && each.row.metric == row.metric;
  });
  return found == golden.scores.end() ? nullptr : &*found;
}

void find_unknown(const GoldenCase& golden, const Scores& scores, const std::map<std::string, cv::Mat>& images,
                  GateResult& result) {
  for (const auto& row : scores.rows)
    if (!find(golden, row)) {
      result.findings.push_back({name_of(row), "not in the reference: obsolete"});
      result.verdict = GateVerdict::obsolete;
    }
  for (const auto& [stem, image] : images)
    if (!golden.images.count(stem)) {
      result.findings.push_back({"image " + stem, "not in the reference: obsolete"});
      result.verdict = GateVerdict::obsolete;
    }
}

// The misses of a run, each with its reason.
std::map<std::string, std::string> explained_misses(const GoldenCase& golden, const Scores& scores,
                                                    const std::map<std::string, std::string>& miss_reasons) {
  std::map<std::string, std::string> misses;
  std::string without, example;
  for (const auto& each : target_results(scores)) {
    if (each.met) continue;
    const auto given = miss_reasons.find(each.name()), known = golden.known_misses.find(each.name());
    if (given != miss_reasons.end() && !given->second.empty())
      misses[each.name()] = given->second;
    else if (known != golden.known_misses.end())
      misses[each.name()] = known->second;
    else
      without += fmt::format("{}{} ({}, target {})", without.empty() ? "" : ", ", each.name(), each.value_text(),
                             each.metric->target_text());
    if (example.empty() && !misses.count(each.name())) example = each.name();
  }
  if (!without.empty())
    throw InputError("--miss", fmt::format("no reason given for missed targets: {}; expected one each, --miss "
                                           "\"{}=why it is missed\"",
                                           without, example));
  for (const auto& [metric, reason] : miss_reasons)
    if (!misses.count(metric)) throw InputError("--miss " + metric, "is no target that this run misses");
  return misses;
}

}  // namespace

GateResult compare_with_golden(const GoldenCase& golden, const Scores& scores,
                               const std::map<std::string, cv::Mat>& images) {
  GateResult result;
  compare_scores(golden, scores, result);
  compare_targets(golden, scores, result);
  compare_images(golden, images, result);
  if (!result.findings.empty()) result.verdict = GateVerdict::regression;
  if (result.verdict == GateVerdict::pass) find_unknown(golden, scores, images, result);
  return result;
}

double nuisance_tolerance(const ScoreRow& row) {
  const Metric* metric = find_metric(row.stage, row.metric);
  if (!metric) throw std::logic_error("no metric declares " + name_of(row));
  if (!std::isfinite(row.value)) return 0;  // what was not measured is compared by its status
  return metric->nuisance().tolerance(row.value);
}

GoldenCase accepted(const GoldenCase& golden, const Scores& scores, const std::map<std::string, cv::Mat>& images,
                    const std::string& reason, const std::map<std::string, std::string>& miss_reasons) {
  GoldenCase result = golden;
  result.known_misses = explained_misses(golden, scores, miss_reasons);
  result.scores.clear();
  std::string changes;
  for (const auto& row : scores.rows) {
    const GoldenScore* old = find(golden, row);
    if (old && within(*old, row)) {
      result.scores.push_back(*old);
      continue;
    }
    result.scores.push_back({row, nuisance_tolerance(row)});
    result.scores.back().row.n_samples = 0;
    if (old) changes += fmt::format("; {}: {:.6g} -> {:.6g}", name_of(row), old->row.value, row.value);
  }
  for (const auto& [stem, image] : images) {
    const auto old = golden.images.find(stem);
    if (old == golden.images.end() || image_difference(old->second, image) > kImageTolerance)
      result.images[stem] = image;
  }
  for (auto it = result.images.begin(); it != result.images.end();)
    it = images.count(it->first) ? std::next(it) : result.images.erase(it);
  result.history.push_back(reason + changes);
  return result;
}

cv::Mat flip_image(const cv::Mat& now, const cv::Mat& reference) {
  if (now.size() != reference.size()) return now;
  cv::Mat difference, row;
  cv::absdiff(now, reference, difference);
  cv::hconcat(std::vector<cv::Mat>{now, reference, difference * 10}, row);
  return row;
}

}  // namespace dressform
