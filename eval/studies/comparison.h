#pragma once
#include <optional>
#include <string>
#include <vector>

#include "eval/score/metric.h"
#include "eval/studies/statistics.h"

namespace dressform {

// What one variant gave on one scene for one metric, its seeds averaged. Failed: with some seed it gave nothing to
// measure. Absent: the truth has no such thing, or the cell is not there yet.
struct Outcome {
  enum class State { measured, failed, absent };
  State state = State::absent;
  double value = 0;
};

struct ScenePair {
  std::string scene;
  Outcome baseline, variant;
};

enum class Verdict { better, worse, equivalent, inconclusive };
std::string to_text(Verdict verdict);

struct SuccessRate {
  int successes = 0, trials = 0;
  Interval interval;  // Wilson's
};

// A variant against the baseline, by one metric.
struct Comparison {
  struct Difference {
    std::string scene;
    double value;  // variant minus baseline, in the metric's unit
  };
  std::vector<Difference> differences;  // of the complete pairs, in the order of the scenes
  double baseline_mean = 0, variant_mean = 0;
  double effect = 0;  // mean difference; NaN without a pair
  std::optional<Interval> interval;
  std::optional<double> p;       // two-sided sign-flip; absent below kFewestScenes
  std::optional<double> p_holm;  // adjusted over the primary family
  std::optional<double> p_equivalent;
  double detectable = 0;  // smallest effect that these differences would have shown, in the metric's unit
  SuccessRate baseline_success, variant_success;
  // Failure as the worst rank: on how many scenes the variant was better and worse, and the sign-flip p of the ranks.
  struct WithFailures {
    int better = 0, worse = 0, equal = 0;
    std::optional<double> p;
  } with_failures;
  Verdict verdict = Verdict::inconclusive;

  int pairs() const { return static_cast<int>(differences.size()); }
};

// All but p_holm and the verdict. `margin`: 0 where none was declared.
Comparison compared(const std::vector<ScenePair>& pairs, Better direction, double margin, Seed seed);

// Adjusts the p of the primary metrics of one comparison together and gives each its verdict: equivalent when the mean
// difference lies within the margin by two one-sided tests; else better or worse when the adjusted p says so; else
// inconclusive. A variant that fails more often, and is worse for it with failures as the worst rank, is worse, or
// inconclusive where it is better on the scenes that are left. Always inconclusive below kFewestScenes.
void judge_family(std::vector<Comparison>& family, const std::vector<Better>& directions);

}  // namespace dressform
