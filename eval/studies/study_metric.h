#pragma once
#include <string>

#include "eval/score/metric.h"
#include "eval/score/scores.h"
#include "eval/studies/comparison.h"

namespace dressform {

// A metric that a study asks for: a row ("registration max/tre_mm@1"), or the mean over all rows of a declared metric
// ("surface <slot>/f_5mm@1": over the garments that are worn).
struct StudyMetric {
  std::string text;  // "surface <slot>/f_5mm@1"
  std::string stage, row;
  const Metric* metric = nullptr;
  bool primary = false;
  double margin = 0;  // differences within it do not matter; primary metrics have one

  bool whole_family() const { return row.find('<') != std::string::npos; }
  bool takes(const ScoreRow& score) const;
};

// Throws InputError naming `where` when no such metric is declared, its version is another one, or it has no direction.
StudyMetric study_metric(const std::string& where, const std::string& text);

// What one run gave for it. A metric that should be near zero is taken as its magnitude. Failed where any of its rows
// is; absent where the truth has none.
Outcome outcome_of(const StudyMetric& metric, const std::vector<ScoreRow>& rows);

// A difference in the metric's unit: "+0.034", "-1.20 mm".
std::string difference_text(const StudyMetric& metric, double value);

}  // namespace dressform
