#pragma once
#include <optional>
#include <string>
#include <vector>

#include "eval/score/scores.h"

namespace dressform {

// The measures that people look at first, against the targets of the pipeline: metrics that declare a headline.
struct ScoreLine {
  std::string part;     // "registration", "top", "bottom", ...
  std::string measure;  // "worst rotation"
  std::string value;    // with its unit; "failed" where the pipeline gave nothing
  std::string target;   // "<= 0.5 deg"; empty where there is none
  enum class State { plain, met, missed } state = State::plain;
  double from_scale = 0;  // resolution from which the target is meant to hold
  bool judged() const { return state != State::plain; }
  bool missed() const { return state == State::missed; }
};
std::vector<ScoreLine> score_lines(const Scores& scores);

// How many of the targets were met, and how many of those that were missed are only meant to hold at a larger scale
// than that of the run (absent: not known).
struct TargetCount {
  int judged = 0, missed = 0, missed_below_scale = 0;
};
TargetCount count_targets(const std::vector<ScoreLine>& lines, std::optional<double> scale);

// The same as a table for the terminal.
std::string score_table_text(const Scores& scores, std::optional<double> scale = {});

}  // namespace dressform
