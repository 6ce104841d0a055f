#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/run/stage_problems.h"
#include "eval/score/scores.h"
#include "pipeline/reconstruct.h"
#include "scenes/ground_truth.h"

namespace dressform {

struct ReportInput {
  const Reconstruction& reconstruction;
  const CaptureSession& session;
  const std::optional<Scores>& scores;
  const GroundTruth* truth;  // null for a recording
  const nlohmann::json& facts;
  const std::vector<StageProblem>& problems;
};

// Writes report.html (self-contained: opens from disk, fetches nothing) and renders/*.png into the run folder. Returns
// the file names, relative to the folder.
std::vector<std::string> write_report(const ReportInput& input, const std::filesystem::path& folder);

// Of the report's images those of the finished clothes alone, renders/result_mannequin.png and, where there is a user,
// renders/result_user.png; the same bytes as the report's.
std::vector<std::string> write_result_images(const Reconstruction& reconstruction, const std::filesystem::path& folder);

}  // namespace dressform
