#pragma once
#include <filesystem>
#include <map>
#include <opencv2/core/mat.hpp>
#include <string>

#include "eval/gate/golden_case.h"
#include "eval/run/scene_run.h"

namespace dressform {

// What the gate looks at in a run: its scores, and its result images made small.
struct GoldenRun {
  Scores scores;
  std::map<std::string, cv::Mat> images;
};

// Runs a case in `work`/<name> (the store is shared by all cases below `work`).
GoldenRun run_golden_case(const GoldenCase& golden_case, const std::filesystem::path& golden,
                          const std::filesystem::path& work, int threads, const SceneRunProgress& progress = {});

}  // namespace dressform
