#include "pipeline/run/picks_in_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "pipeline/run/stage_runner.h"
#include "scenes/error.h"

namespace dressform {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Isometry3d pose(double degrees, const Vector3d& translation) {
  Isometry3d result = Isometry3d::Identity();
  result.linear() = Eigen::AngleAxisd(degrees * M_PI / 180, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  result.translation() = translation;
  return result;
}

const std::vector<Vector3d> kPoints{{0.1, 0.2, 2}, {-0.3, 0.1, 1.9}, {0, 0, 2.1}};
const Isometry3d kSensor = pose(70, {0.5, 1.2, -2}), kNaked = pose(-20, {0.1, 1.1, 2}), kUser = pose(35, {0, 0.9, 1.8});

struct Known {
  BodyModel naked, user;
  Registration registration;
  Known() {
    naked.model_from_frame = {kNaked, Isometry3d::Identity()};
    user.model_from_frame = {kUser, Isometry3d::Identity()};
    registration.model_from_sensor["k1"] = kSensor;
  }
};

Picks picked_in(const std::vector<std::string>& frames) {
  Picks picks;
  for (const auto& frame : frames) picks.points["control"].push_back({frame, kPoints});
  return picks;
}

// The frames that come out, and the points as they should be.
void expect_at(const PickedPoints& found, const std::string& frame, const Isometry3d& pose) {
  EXPECT_EQ(found.frame, frame);
  ASSERT_EQ(found.points.size(), kPoints.size());
  for (std::size_t i = 0; i < kPoints.size(); ++i) EXPECT_LT((found.points[i] - pose * kPoints[i]).norm(), 1e-12);
}

TEST(PicksInModel, EveryFrameGoesWhereItStands) {
  const Known known;
  const Picks found = in_model_frame(picked_in({"model", "k1", "scan_naked", "user", "scan_user"}), known.naked,
                                     known.registration, &known.user);
  const auto& parts = found.points.at("control");
  ASSERT_EQ(parts.size(), 5u);
  expect_at(parts[0], "model", Isometry3d::Identity());
  expect_at(parts[1], "model", kSensor);
  expect_at(parts[2], "model", kNaked);
  expect_at(parts[3], "user", Isometry3d::Identity());
  expect_at(parts[4], "user", kUser);
}

TEST(PicksInModel, WithoutAPoseThereAreNoPoints) {
  Known known;
  EXPECT_TRUE(in_model_frame(picked_in({"k2"}), known.naked, known.registration).points.empty());
  EXPECT_TRUE(in_model_frame(picked_in({"scan_user"}), known.naked, known.registration).points.empty());
  known.naked.model_from_frame.front().matrix().setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(in_model_frame(picked_in({"scan_naked"}), known.naked, known.registration).points.empty());
  known.naked.model_from_frame.clear();
  EXPECT_TRUE(in_model_frame(picked_in({"scan_naked"}), known.naked, known.registration).points.empty());
}

TEST(PicksInModel, RegionsStayAsTheyAre) {
  const Known known;
  Picks picks;
  picks.regions["region_top_k1"] = cv::Mat(3, 4, CV_8UC1, cv::Scalar(255));
  const Picks found = in_model_frame(picks, known.naked, known.registration);
  EXPECT_THAT(found.names(), ElementsAre("region_top_k1"));
  EXPECT_EQ(found.regions.at("region_top_k1").data, picks.regions.at("region_top_k1").data);
}

// The key of what a picking variant makes depends on the picks and on what carries them, and on nothing else.
TEST(PicksInModel, HashFollowsPicksAndPoses) {
  const auto picks = [](const char* hash) { return LazyArtifact<Picks>(hash, [] { return picked_in({"k1"}); }); };
  const auto body = [](const char* hash) { return LazyArtifact<BodyModel>(hash, [] { return Known().naked; }); };
  const auto poses = [](const char* hash) {
    return LazyArtifact<Registration>(hash, [] { return Known().registration; });
  };
  const auto made = in_model_frame(picks("p"), body("n"), poses("r"));
  EXPECT_EQ(made.content_hash(), in_model_frame(picks("p"), body("n"), poses("r")).content_hash());
  EXPECT_NE(made.content_hash(), in_model_frame(picks("q"), body("n"), poses("r")).content_hash());
  EXPECT_NE(made.content_hash(), in_model_frame(picks("p"), body("m"), poses("r")).content_hash());
  EXPECT_NE(made.content_hash(), in_model_frame(picks("p"), body("n"), poses("s")).content_hash());
  EXPECT_NE(made.content_hash(), in_model_frame(picks("p"), body("n"), poses("r"), body("u")).content_hash());
  expect_at(made.get().points.at("control").at(0), "model", kSensor);
}

// A session that was never opened: whoever reads more of it than its picks fails.
SessionSource unread(std::optional<LazyArtifact<Picks>> picks) {
  const auto fail = []() -> CaptureSession { throw std::logic_error("the session was read"); };
  const auto no_scan = []() -> DepthScan { throw std::logic_error("a scan was read"); };
  return {LazyArtifact<CaptureSession>("s", fail), LazyArtifact<DepthScan>("d", no_scan), {}, {"k1"}, "h", {}, picks};
}

TEST(PicksInModel, WhatIsMissingIsSaidBeforeAnythingRuns) {
  ReconstructionOptions options;
  check_picks(options, unread({}));  // automatic variants ask for nothing
  options.variants["open"] = "thesis_picked";
  const auto complaint = [&](const std::optional<Picks>& picks) -> std::string {
    std::optional<LazyArtifact<Picks>> lazy;
    if (picks) lazy = LazyArtifact<Picks>("p", [picks] { return *picks; });
    try {
      check_picks(options, unread(lazy));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  Picks picks;
  picks.points["border_top_front_left"] = {{"model", kPoints}};
  for (const std::string& text : {complaint({}), complaint(picks)}) {
    EXPECT_THAT(text, HasSubstr("rim_*"));
    EXPECT_THAT(text, HasSubstr("open=thesis_picked"));
    EXPECT_THAT(text, HasSubstr("top_closed.ply in MeshLab"));
  }
  picks.points["rim_bottom_hem"] = {{"model", kPoints}};
  EXPECT_EQ(complaint(picks), "");
}

// What a stage makes without asking for picks is found again whatever was picked, and when the picks are gone.
TEST(PicksInModel, NoAutomaticStageDependsOnThem) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "store_without_picks";
  std::filesystem::remove_all(folder);
  ArtifactStore store(folder);
  const LazyArtifact<CaptureSession> session("s", [] {
    CaptureSession made;
    made.calibration.emplace();
    made.calibration->sensors["k1"].ir = Camera{32, 26, 23, 23, 15.5, 12.5, {}};
    return made;
  });
  const ReconstructionOptions options;
  std::string key, bytes;
  for (const char* picks : {"", "p", "q"}) {
    StageRunner runner(options, store, {});
    if (*picks) runner.set_picks(LazyArtifact<Picks>(picks, []() -> Picks { throw std::logic_error("picks read"); }));
    const auto made = runner.run<Calibrate>("calibrate", session);
    const StageRecord& record = runner.records().front();
    EXPECT_EQ(record.reused, *picks != 0);
    if (key.empty()) key = record.key, bytes = made.content_hash();
    EXPECT_EQ(record.key, key);
    EXPECT_EQ(made.content_hash(), bytes);
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace dressform
