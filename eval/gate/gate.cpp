#include "eval/gate/gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

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

double image_difference(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return 255;
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  const cv::Scalar mean = cv::mean(difference);
  return (mean[0] + mean[1] + mean[2]) / 3;
}

const ScoreRow* find(const Scores& scores, const ScoreRow& like) { return scores.find(like.stage, like.metric); }

void compare_scores(const GoldenCase& golden, const Scores& scores, GateResult& result) {
  for (const auto& reference : golden.scores) {
    ++result.compared;
    const std::string what = reference.row.stage + " " + reference.row.metric;
    const ScoreRow* now = find(scores, reference.row);
    if (!now)
      result.findings.push_back({what, "no longer measured"});
    else if (!within(reference, *now))
      result.findings.push_back(
          {what, fmt::format("reference {:.6g} ({}), new {:.6g} ({}), tolerance {:.3g} {}", reference.row.value,
                             reference.row.status, now->value, now->status, reference.tolerance, now->unit)});
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

void find_unknown(const GoldenCase& golden, const Scores& scores, const std::map<std::string, cv::Mat>& images,
                  GateResult& result) {
  for (const auto& row : scores.rows) {
    const auto same = [&](const GoldenScore& each) {
      return each.row.stage == row.stage && each.row.metric == row.metric;
    };
    if (std::none_of(golden.scores.begin(), golden.scores.end(), same)) {
      result.findings.push_back({row.stage + " " + row.metric, "not in the reference: obsolete"});
      result.verdict = GateVerdict::obsolete;
    }
  }
  for (const auto& [stem, image] : images)
    if (!golden.images.count(stem)) {
      result.findings.push_back({"image " + stem, "not in the reference: obsolete"});
      result.verdict = GateVerdict::obsolete;
    }
}

}  // namespace

GateResult compare_with_golden(const GoldenCase& golden, const Scores& scores,
                               const std::map<std::string, cv::Mat>& images) {
  GateResult result;
  compare_scores(golden, scores, result);
  compare_images(golden, images, result);
  if (!result.findings.empty()) result.verdict = GateVerdict::regression;
  if (result.verdict == GateVerdict::pass) find_unknown(golden, scores, images, result);
  return result;
}

double nuisance_tolerance(const ScoreRow& row) {
  if (!std::isfinite(row.value)) return 0;  // what was not measured is compared by its status
  if (row.unit == "mm") return 0.25 + 0.02 * std::abs(row.value);
  if (row.unit == "deg") return 0.02;
  if (row.unit == "count") return 0;
  if (row.unit == "dB") return 0.2;
  return 0.01;
}

GoldenCase accepted(const GoldenCase& golden, const Scores& scores, const std::map<std::string, cv::Mat>& images,
                    const std::string& reason) {
  GoldenCase result = golden;
  result.scores.clear();
  std::string changes;
  for (const auto& row : scores.rows) {
    const auto old = std::find_if(golden.scores.begin(), golden.scores.end(), [&](const GoldenScore& each) {
      return each.row.stage == row.stage && each.row.metric == row.metric;
    });
    if (old != golden.scores.end() && within(*old, row)) {
      result.scores.push_back(*old);
      continue;
    }
    result.scores.push_back({row, nuisance_tolerance(row)});
    result.scores.back().row.n_samples = 0;
    if (old != golden.scores.end())
      changes += fmt::format("; {} {}: {:.6g} -> {:.6g}", row.stage, row.metric, old->row.value, row.value);
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
