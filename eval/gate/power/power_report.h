#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eval/gate/power/power_run.h"

namespace dressform {

// How often a fault of one size was found.
struct Detection {
  std::size_t size = 0;
  int found = 0, placed = 0;  // over cases and placements
  double at_least = 0;        // Wilson's lower bound of the rate, 95 %
};

// A fault's detection by size. Placements in which the fault changed no byte are no trials: there was nothing to find.
struct DetectionCurve {
  Fault fault;
  std::vector<Detection> sizes;
  int without_effect = 0;
  // The smallest of the sizes from which on at least 95 % of the placements were found; absent where not even the
  // largest was.
  std::optional<double> size_found;
};
std::vector<DetectionCurve> detection_curves(const std::vector<Fault>& faults, const std::vector<PowerCell>& cells);

// Who was blamed: rows the step with the fault, columns the step or stage that was blamed ("none" where nobody was).
struct BlameMatrix {
  std::map<std::string, std::map<std::string, int>> counts;
  int right = 0, total = 0;
};
BlameMatrix blame_by_bytes(const std::vector<PowerCell>& cells);
// Of the cells that were found; `scores` tells which stages have numbers of their own.
BlameMatrix blame_by_numbers(const std::vector<PowerCell>& cells, const Scores& scores);

// The curves as a table, how many faults of each size word were found, and what was missed.
std::string curves_text(const std::vector<DetectionCurve>& curves);
std::string blame_text(const BlameMatrix& matrix, const std::string& title);

}  // namespace dressform
