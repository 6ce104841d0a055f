#pragma once
#include <map>
#include <string>
#include <vector>

#include "eval/gate/golden_case.h"

namespace dressform {

enum class GateVerdict { pass, regression, obsolete };

// One comparison that failed.
struct GateFinding {
  std::string what;     // "top f_5mm@1", "image result_user"
  std::string message;  // reference, new, difference and tolerance
};
// One target of the run.
struct GateTarget {
  std::string metric;     // "surface top/f_5mm@1"
  std::string value;      // "0.963"
  std::string target;     // ">= 0.85"
  double from_scale = 0;  // resolution from which it is meant to hold
  bool met = false;
  std::string known;  // of a miss that the reference knows: why
};
struct GateResult {
  GateVerdict verdict = GateVerdict::pass;
  std::vector<GateFinding> findings;
  std::vector<GateFinding> better;  // beyond tolerance in the good direction, and known misses that are met: to accept
  std::vector<GateTarget> targets;
  int compared = 0;
};

// Compares a run with its reference. A number that is worse beyond its tolerance, another status, a number that went
// missing, and a missed target that the reference does not know are regressions; numbers or images that the reference
// does not know make it obsolete.
GateResult compare_with_golden(const GoldenCase& golden, const Scores& scores,
                               const std::map<std::string, cv::Mat>& images);

// How far nuisance (compiler, instruction set, platform) may move this number, by the declaration of its metric. Throws
// std::logic_error for a row that nobody declared.
double nuisance_tolerance(const ScoreRow& row);

// The case with the run's numbers and images accepted where they are new or beyond tolerance; the others are left as
// they were. The history gains `reason` and the largest changes. Targets that are missed become known misses, for the
// reason that `miss_reasons` (by "stage metric") or else the case gives; throws InputError naming those without one,
// and reasons for what is not missed.
GoldenCase accepted(const GoldenCase& golden, const Scores& scores, const std::map<std::string, cv::Mat>& images,
                    const std::string& reason, const std::map<std::string, std::string>& miss_reasons = {});

// New, reference and ten times their difference, side by side.
cv::Mat flip_image(const cv::Mat& now, const cv::Mat& reference);

}  // namespace dressform
