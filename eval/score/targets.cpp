#include "eval/score/targets.h"

namespace dressform {

std::string value_text(const ScoreRow& row) {
  return row.status == "ok" ? number_text(row.value, row.unit) : row.status;
}

std::string TargetResult::value_text() const { return dressform::value_text(*row); }

std::vector<TargetResult> target_results(const Scores& scores) {
  std::vector<TargetResult> results;
  for (const auto& row : scores.rows) {
    if (row.status == "absent") continue;
    const Metric* metric = find_metric(row.stage, row.metric);
    if (!metric || !metric->target || !metric->judges(*metric->members_of(row.metric))) continue;
    results.push_back({metric, &row, row.status == "ok" && metric->meets_target(row.value)});
  }
  return results;
}

}  // namespace dressform
