#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipeline/reconstruct.h"

namespace dressform {

// What one stage did not manage, and why as far as its results tell.
struct StageProblem {
  std::string stage;             // label of its record: "registration", "fuse_user"
  std::string what;              // "k2 was not registered: did not converge on 120 points"
  bool garment_missing = false;  // from out/, because of it
  std::string slot;              // which one; empty where no stage can tell

  std::string text() const { return stage + ": " + what; }
};

// In the order of the pipeline; empty when every stage made what it was given to make. Reads results only: nothing is
// decided here that a stage decides.
std::vector<StageProblem> stage_problems(const Reconstruction& made);

// The same with the garments that the ground truth knows and no stage found or lost by name.
std::vector<StageProblem> with_unfound_garments(std::vector<StageProblem> problems, const Reconstruction& made,
                                                const std::vector<std::string>& worn);

// Whether a garment is missing from out/ by one of the problems.
bool garments_missing(const std::vector<StageProblem>& problems);

// For problems.json and run.json: [{"stage", "what", "garment_missing", "slot"}, ...]; and back.
nlohmann::json to_json(const std::vector<StageProblem>& problems);
std::vector<StageProblem> problems_from_json(const nlohmann::json& rows);

}  // namespace dressform
