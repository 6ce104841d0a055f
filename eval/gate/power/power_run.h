#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "eval/gate/gate.h"
#include "eval/gate/power/fault.h"

namespace dressform {

// A case without faults: what faults are put into, and what their runs are held against.
struct PowerBase {
  std::string name;
  GoldenCase reference;  // of its own run, accepted as it is
  GoldenRun run;
  SceneRunRequest request;
  std::vector<StageRecord> records;
  std::filesystem::path session;
};
PowerBase power_base(const std::string& name, const GoldenRunRequest& request, const SceneRunProgress& progress = {});

// A reference of a run as it is, whatever targets it misses.
GoldenCase reference_of(const std::string& name, const GoldenRun& run);

// One fault in one size at one place, and what the gate says to it.
struct PowerCell {
  std::string case_name, fault, step;  // fault: its id
  std::size_t size = 0;                // index into the fault's sizes
  int placement = 0;
  bool found = false;      // by numbers and pictures alone, as another environment would have to
  bool crashed = false;    // the pipeline ended with an error: found as well
  std::string by_bytes;    // the step that bytes blame; empty: none changed, so the fault did nothing there
  std::string by_numbers;  // the first stage of which a number or picture failed; empty where none did
  std::string worst;       // the finding that is most tolerances off
};

struct PowerRequest {
  std::filesystem::path work;  // runs of cells, and cells/: what each showed, so that nothing is run twice
  int threads = 1;
};

// Runs the pipeline from the fault's step on (all before is taken from the base's store), or finds what an earlier run
// of the same cell showed, and judges it. Never touches the base's store.
PowerCell power_cell(const PowerBase& base, const Fault& fault, std::size_t size, int placement,
                     const PowerRequest& request, const MeasuredNuisance& nuisance);

// What the gate says to a run with a fault.
PowerCell judged_cell(const PowerBase& base, const Fault& fault, std::size_t size, int placement, const GoldenRun& run,
                      const MeasuredNuisance& nuisance);

// Whether numbers blame the right stage: its own where it has scores, else none before it.
bool blamed_right_by_numbers(const PowerCell& cell, const Scores& scores);

// The stage of the scores that a step belongs to: "fuse" of "fuse_naked", "landmarks" of "landmarks_user".
std::string stage_of_step(const std::string& step);

}  // namespace dressform
