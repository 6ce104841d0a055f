#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/run/stage_problems.h"
#include "eval/score/scores.h"
#include "pipeline/reconstruct.h"

namespace dressform {

// From a capture session to the files of a run folder. Each step does only what is missing or out of date.
struct EndToEndRequest {
  std::filesystem::path session, output, store;
  std::string scene, variant;  // names for the scores
  ReconstructionOptions options;
  bool check_session = true;  // read and check all of it first (recordings); false: it lies in the store, intact
  int threads = 1;
  bool report = true;                               // false: report.html and renders/ are not made
  bool result_images = false;                       // without a report: of renders/ the two finished results alone
  std::vector<std::string> oracles = {};            // stages that truth stands in for (eval/oracle/oracle.h)
  nlohmann::json facts = nlohmann::json::object();  // more for run.json
};

struct EndToEndProgress {
  StageProgress stage;
  std::function<void(const std::string& step)> step;  // "scores" begins
  std::function<void(const std::string& step, bool made_now, double seconds)> step_finished;
};

struct EndToEndResult {
  std::optional<Scores> scores;  // absent without ground truth
  std::optional<double> scale;   // of the capture, where it is known
  std::vector<StageProblem> problems;
  std::filesystem::path report;
  std::vector<StageRecord> records;
};

// Throws InputError before anything is written when the session, an option or the output folder is bad.
EndToEndResult run_end_to_end(const EndToEndRequest& request, const EndToEndProgress& progress);

}  // namespace dressform
