#pragma once
#include <filesystem>
#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "eval/gate/bytes.h"
#include "eval/gate/golden_case.h"
#include "eval/run/scene_run.h"

namespace dressform {

// What the gate looks at in a run: its scores, its result images made small, and the bytes of every step.
struct GoldenRun {
  Scores scores;
  std::map<std::string, cv::Mat> images;  // file stem -> 8-bit BGR
  std::vector<StepBytes> steps;
  Environment environment;
  // Hash over scores, images and bytes: two runs with one identity are the same run to the gate.
  std::string identity() const;
};

struct GoldenRunRequest {
  std::filesystem::path golden, work;  // folders of the references and of the runs
  int threads = 1;
  bool report = false;  // with report.html and all its images
};

// Runs a case in `work`/<name> (the store is shared by all cases below `work`), and keeps what it saw there in gate/.
GoldenRun run_golden_case(const GoldenCase& golden_case, const GoldenRunRequest& request,
                          const SceneRunProgress& progress = {});

// How a case is run, for those who run it otherwise.
SceneRunRequest scene_request(const GoldenCase& golden_case, const GoldenRunRequest& request);

// What a run that is done shows the gate, from its result and its folder.
GoldenRun golden_run_of(const EndToEndResult& result, const SceneRunRequest& request);

// What the last run of a case in this folder showed, by this program or another one: `folder`/observed.json with its
// images. Throws InputError naming the file that is missing, damaged or of another format.
GoldenRun read_golden_run(const std::filesystem::path& folder);
void write_golden_run(const std::filesystem::path& folder, const GoldenRun& run);
// Where the runs of a case are kept: `work`/<name>/gate.
std::filesystem::path observed_folder(const std::filesystem::path& work, const std::string& name);

}  // namespace dressform
