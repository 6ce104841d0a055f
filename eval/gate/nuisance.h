#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eval/gate/golden_run.h"
#include "eval/gate/picture_difference.h"

namespace dressform {

// How far other environments (compiler, optimisation, instruction sets, renderer, package versions) really move the
// numbers and pictures of one and the same code: golden/nuisance.json. Says nothing about noise seeds, which are
// another budget.
struct MeasuredNuisance {
  struct Place {
    std::string name;  // how it was started
    Environment environment;
    int changed_steps = 0;  // steps whose bytes are not those of the reference's; 0: the same program in effect
  };
  std::vector<Place> places;       // the first is the reference; no two have one environment
  std::vector<std::string> cases;  // that were run in each
  // By metric as it is declared ("surface <slot>/f_5mm@1"): the largest distance from the reference over all its rows
  // and cases, in the metric's unit, place by place (0 for the first).
  std::map<std::string, std::vector<double>> metrics;
  std::map<std::string, std::vector<double>> pictures;  // "mean_levels", "worst_tile_levels", "flip", "worst_tile_flip"
  std::vector<std::string> status_changes;              // rows that are measured in one place and failed in another

  // Places that are samples: the reference, and those with other bytes than its. A place with the same bytes is the
  // same program in effect, however its environment is called.
  std::size_t distinct() const;
  bool usable() const;  // enough distinct places to say anything
  // Of a row, from all places but the one `left_out` (its index; -1: from all). Absent where nothing was measured for
  // its metric.
  std::optional<double> tolerance(const ScoreRow& row, int left_out = -1) const;
  PictureTolerance picture_tolerance(int left_out = -1) const;  // the declared one where nothing was measured
};

// What the runs of the same cases in several places say; the first is the reference. Throws InputError naming the place
// that lacks a case, or has the environment of another one.
struct PlaceRuns {
  std::string name;
  std::map<std::string, GoldenRun> runs;  // by case
};
MeasuredNuisance measure_nuisance(const std::vector<PlaceRuns>& places);

// Each distinct place but the reference judged by the tolerance of all others.
struct LeftOutPlace {
  std::string name;
  std::vector<std::string> alarms;  // metrics and pictures that would have been called changed
};
std::vector<LeftOutPlace> leave_one_out(const MeasuredNuisance& nuisance);
// With 95 % confidence at most this part of all such environments is alarmed, when `alarmed` of `count` were (Clopper
// and Pearson 1934, one-sided): 0 of 8 says 31 %, 0 of 59 says 5 %.
double alarm_rate_bound(int alarmed, int count);

// golden/nuisance.json; nothing when there is none. Throws GoldenError naming the file that is damaged.
std::optional<MeasuredNuisance> read_nuisance(const std::filesystem::path& golden);
void write_nuisance(const std::filesystem::path& golden, const MeasuredNuisance& nuisance);

}  // namespace dressform
