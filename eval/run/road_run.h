#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "eval/evaluate.h"
#include "eval/run/run_folder.h"
#include "pipeline/reconstruct.h"

namespace dressform {

// From a capture session to the files of a run folder. Each step does only what is missing or out of date.
struct RoadRunRequest {
  std::filesystem::path session, output, store;
  std::string scene;             // name, for the scores
  ReconstructionOptions options;
  bool check_session = true;     // read and check all of it first (recordings); false: it lies in the store, intact
  nlohmann::json facts;          // for run.json
};

struct RoadRunProgress {
  StageProgress stage;
  std::function<void(const std::string& step)> step;                        // "score", "pictures", "report" begins
  std::function<void(const std::string& step, bool made_now)> step_finished;
};

struct RoadRunResult {
  std::optional<Scores> scores;  // absent without ground truth
  std::filesystem::path report;
  std::vector<StageRecord> records;
};

// Throws InputError before anything is written when the session, an option or the output folder is bad.
RoadRunResult run_road(const RoadRunRequest& request, const RoadRunProgress& progress);

}  // namespace dressform
