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
struct GateResult {
  GateVerdict verdict = GateVerdict::pass;
  std::vector<GateFinding> findings;
  int compared = 0;
};

// Compares a run with its reference. A number beyond its tolerance, another status or a number that went missing is a
// regression; numbers or images that the reference does not know make it obsolete.
GateResult compare_with_golden(const GoldenCase& golden, const Scores& scores,
                               const std::map<std::string, cv::Mat>& images);

// How far nuisance (compiler, instruction set, platform) may move a number of this unit.
double nuisance_tolerance(const ScoreRow& row);

// The case with the run's numbers and images accepted where they are new or beyond tolerance; the others are left as
// they were. The history gains `reason` and the largest changes.
GoldenCase accepted(const GoldenCase& golden, const Scores& scores, const std::map<std::string, cv::Mat>& images,
                    const std::string& reason);

// New, reference and ten times their difference, side by side.
cv::Mat flip_image(const cv::Mat& now, const cv::Mat& reference);

}  // namespace dressform
