#pragma once
#include <string>
#include <vector>

#include "eval/score/metric.h"
#include "eval/score/scores.h"

namespace dressform {

// A row that a target is asked of. What the truth does not have (`absent`) is not judged; what failed missed it.
struct TargetResult {
  const Metric* metric;
  const ScoreRow* row;  // of the scores
  bool met = false;
  std::string name() const { return row->stage + " " + row->metric; }
  // The number, or the row's status where there is none: "0.184 deg", "failed".
  std::string value_text() const;
};

// In the order of the rows, which must outlive the result.
std::vector<TargetResult> target_results(const Scores& scores);

// A row's number with its unit, or its status: "failed", "absent".
std::string value_text(const ScoreRow& row);

}  // namespace dressform
