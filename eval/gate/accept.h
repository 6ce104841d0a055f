#pragma once
#include <map>
#include <string>
#include <vector>

#include "eval/gate/gate.h"

namespace dressform {

struct AcceptRequest {
  std::string reason;  // kept in the case's history
  // Only these: "surface top/f_5mm@1", "image result_user". Empty: all that is new or beyond tolerance.
  std::vector<std::string> items;
  std::map<std::string, std::string> miss_reasons;  // "stage metric" of a missed target -> why
};
struct Accepted {
  GoldenCase golden;
  // Numbers that crept too far to be accepted in bulk: they stay as they were, and want to be accepted by their name.
  std::vector<std::string> left;
};

// The case with the run's numbers and images accepted where they are new or beyond tolerance, or named; the others stay
// as they were, so that nothing creeps unseen. The history gains the reason and the largest changes. Targets that are
// missed become known misses, for the reason given here or else known; in an accept of items, only theirs. The bytes of
// the run are kept when it then passes as a whole. Throws InputError naming missed targets without a reason, reasons
// for what is not missed, and items that the run does not have.
Accepted accepted(const GoldenCase& golden, const GoldenRun& run, const AcceptRequest& request,
                  const MeasuredNuisance& nuisance = {});

// New, reference and ten times their difference, side by side.
cv::Mat comparison_strip(const cv::Mat& now, const cv::Mat& reference);

}  // namespace dressform
