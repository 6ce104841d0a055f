#pragma once
#include <string>
#include <vector>

#include "eval/scores.h"

namespace dressform {

// The measures that people look at first, against the targets of the pipeline.
struct ScoreLine {
  std::string part;     // "registration", "top", "bottom", ...
  std::string measure;  // "worst rotation"
  std::string value;    // with its unit; "failed" where the pipeline gave nothing
  std::string target;   // "<= 0.5 deg"; empty where there is none
  enum class State { plain, met, missed } state = State::plain;
  bool judged() const { return state != State::plain; }
  bool missed() const { return state == State::missed; }
};
std::vector<ScoreLine> score_lines(const Scores& scores);

// The same as a table for the terminal.
std::string score_table_text(const Scores& scores);

}  // namespace dressform
