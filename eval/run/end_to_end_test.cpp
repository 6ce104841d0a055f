// The whole pipeline at a small scale: what is promised of a run folder, whatever the figures are.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "eval/run/scene_run.h"
#include "eval/score/metric.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/hash.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

constexpr double kScale = 0.4;
const fs::path kLibrary = fs::path(DRESSFORM_SOURCE_DIR) / "scenes/library";

SceneRunRequest request_for(const fs::path& folder, const fs::path& scene_file) {
  SceneRunRequest request;
  request.scene = scaled(read_scene(scene_file), kScale);
  request.scale = kScale;
  request.output = folder / "run";
  request.store = folder / "store";
  request.options.seed = 5;
  return request;
}

fs::path fresh_folder(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / ("road_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

// scores.json and everything in out/, by name.
std::map<std::string, std::string> result_hashes(const fs::path& run) {
  std::map<std::string, std::string> hashes{{"scores.json", hash_file(run / "scores.json")}};
  for (const auto& entry : fs::directory_iterator(run / "out"))
    hashes[entry.path().filename().string()] = hash_file(entry.path());
  return hashes;
}

// One run that the tests of this file share: group 4, the quickest.
class EndToEnd : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fresh_folder("shared");
    const auto request = request_for(folder_, kLibrary / "group4.toml");
    result_ = run_scene(request);
    hashes_ = result_hashes(request.output);
  }
  static SceneRunRequest request() { return request_for(folder_, kLibrary / "group4.toml"); }
  static fs::path session() {
    for (const auto& entry : fs::directory_iterator(folder_ / "store/synthesize")) return entry.path() / "session";
    throw std::logic_error("no session in the store");
  }
  static int reused(const EndToEndResult& result) {
    int count = 0;
    for (const auto& record : result.records) count += record.reused;
    return count;
  }

  static fs::path folder_;
  static EndToEndResult result_;
  static std::map<std::string, std::string> hashes_;
};
fs::path EndToEnd::folder_;
EndToEndResult EndToEnd::result_;
std::map<std::string, std::string> EndToEnd::hashes_;

TEST_F(EndToEnd, MakesEveryPromisedFile) {
  for (const char* file :
       {"run.json", "scores.json", "scores.csv", "report.html", "out/registration.json", "out/naked_body.ply",
        "out/user_body.ply", "out/top.ply", "out/top.glb", "out/bottom.ply", "out/bottom.glb", "out/top_fitted.ply",
        "out/top_fitted.glb", "out/bottom_fitted.ply", "out/bottom_fitted.glb", "renders/result_user.png"})
    EXPECT_TRUE(fs::exists(folder_ / "run" / file)) << file;
  const std::string report = read_file_bytes(folder_ / "run/report.html");
  EXPECT_EQ(report.find("http://"), std::string::npos);
  EXPECT_EQ(report.find("https://"), std::string::npos);
  EXPECT_EQ(fs::is_directory(folder_ / "run/stages/01_calibrate"), true);
}

TEST_F(EndToEnd, EveryScoreIsOfADeclaredMetric) {
  ASSERT_GT(result_.scores->rows.size(), 200u);
  for (const auto& row : result_.scores->rows) {
    const Metric* metric = find_metric(row.stage, row.metric);
    ASSERT_NE(metric, nullptr) << row.stage << " " << row.metric;
    EXPECT_EQ(row.unit, metric->unit) << row.metric;
  }
}

TEST_F(EndToEnd, SecondRunDoesNothingAgain) {
  const auto before = fs::last_write_time(folder_ / "run/report.html");
  const auto again = run_scene(request());
  EXPECT_EQ(reused(again), static_cast<int>(again.records.size()));
  EXPECT_EQ(fs::last_write_time(folder_ / "run/report.html"), before);
  EXPECT_EQ(result_hashes(folder_ / "run"), hashes_);
}

TEST_F(EndToEnd, AChangedParameterRerunsItsStageAndWhatFollows) {
  auto changed = request();
  changed.output = folder_ / "changed";
  changed.options.variants["correct"] = "thesis_centroid";
  const auto result = run_scene(changed);
  for (const auto& record : result.records) EXPECT_EQ(record.reused, record.label != "correct") << record.label;
}

TEST_F(EndToEnd, TruncatedArtifactIsMadeAgain) {
  for (const auto& record : result_.records) {
    if (record.label != "open" && record.label != "fit") continue;
    fs::resize_file(folder_ / "store" / record.recipe.stage / record.key / "data.bin", 100);
  }
  const auto again = run_scene(request());
  EXPECT_EQ(reused(again), static_cast<int>(again.records.size()) - 2);
  EXPECT_EQ(result_hashes(folder_ / "run"), hashes_);
}

TEST_F(EndToEnd, ReconstructsTheSameWithoutTruthOnOneThread) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const fs::path copy = fresh_folder("no_truth");
  fs::copy(session(), copy / "session", fs::copy_options::recursive);
  fs::remove_all(copy / "session/truth");
  fs::create_directories(copy / "store");
  fs::copy(folder_ / "store/fuse", copy / "store/fuse", fs::copy_options::recursive);  // EveryFuse has one thread too
  EndToEndRequest request;
  request.session = copy / "session";
  request.output = copy / "run";
  request.store = copy / "store";
  request.options.seed = 5;
  const auto result = run_end_to_end(request, {});
  EXPECT_FALSE(result.scores);
  for (const auto& entry : fs::directory_iterator(copy / "run/out")) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(hash_file(entry.path()), hashes_.at(name)) << name;
  }
}

TEST_F(EndToEnd, DamagedSessionIsRefusedBeforeAnythingIsWritten) {
  const fs::path copy = fresh_folder("damaged");
  fs::copy(session(), copy / "session", fs::copy_options::recursive);
  fs::resize_file(copy / "session/dressed/k2/depth.png", 1000);
  EndToEndRequest request;
  request.session = copy / "session";
  request.output = copy / "run";
  request.store = copy / "store";
  try {
    run_end_to_end(request, {});
    FAIL() << "a truncated image was taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("dressed/k2/depth.png"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(fs::exists(copy / "run"));
  EXPECT_FALSE(fs::exists(copy / "store"));
}

TEST_F(EndToEnd, AKilledRunGoesOnAndEndsWithTheSameBytes) {
  const fs::path folder = fresh_folder("killed");
  const std::string program = DRESSFORM_PROGRAM, scene = (kLibrary / "group4.toml").string();
  const std::string output = (folder / "run").string(), store = (folder / "store").string();
  const std::string scale = std::to_string(kScale);
  const auto start = [&] {
    const pid_t child = fork();
    if (child == 0) {
      execl(program.c_str(), program.c_str(), "run", scene.c_str(), "-o", output.c_str(), "--store", store.c_str(),
            "--seed", "5", "--scale", scale.c_str(), "-q", static_cast<char*>(nullptr));
      _exit(127);
    }
    return child;
  };
  // Killed when each of these has just begun to show: in the middle of what comes next.
  for (const char* sign : {"store/synthesize", "store/fuse", "store/segment", "store/texture", "run/out"}) {
    const pid_t child = start();
    int status = 0;
    while (!fs::exists(folder / sign) && waitpid(child, &status, WNOHANG) == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
  }
  int status = 0;
  waitpid(start(), &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(result_hashes(folder / "run"), hashes_);
}

}  // namespace
}  // namespace dressform
