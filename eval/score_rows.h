#pragma once
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "eval/scores.h"

namespace dressform {

// Collects the rows of one stage.
class StageRows {
 public:
  explicit StageRows(std::string stage) : stage_(std::move(stage)) {}

  // A value that is not finite counts as none.
  void add(const std::string& metric, const std::string& unit, double value, long samples = 1) {
    if (!std::isfinite(value)) return fail(metric, unit);
    rows.push_back({stage_, metric, unit, value, "ok", samples});
  }
  // The pipeline gave nothing to measure.
  void fail(const std::string& metric, const std::string& unit) { without_value(metric, unit, "failed"); }
  // The truth has no such thing.
  void absent(const std::string& metric, const std::string& unit) { without_value(metric, unit, "absent"); }

  std::vector<ScoreRow> rows;

 private:
  void without_value(const std::string& metric, const std::string& unit, const char* status) {
    rows.push_back({stage_, metric, unit, std::numeric_limits<double>::quiet_NaN(), status, 0});
  }
  std::string stage_;
};

}  // namespace dressform
