#include "pipeline/fuse/fuse.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "pipeline/testing/fuse_scans.h"

namespace dressform {
namespace {

using namespace fuse_test;
using test_scene::Figure;
using test_scene::Scan;

// A bust, scanned all round: shoulders are no floor.
TEST(FuseVariants, ABustHasNoFloor) {
  Figure bust = test_scene::standing_figure();
  bust.parts = {bust.parts[0], bust.parts[2], bust.parts[3], bust.parts[4], bust.parts[5]};
  bust.floor = false;
  const SensorCalibration calibration = test_scene::kinect(0.25);
  const Scan scan = test_scene::walk_round(bust, calibration, 120, 390, 1, 7);
  const BodyModel model = Fuse::at("pose_graph").run(scan.scan, calibration, {}, 1);
  EXPECT_FALSE(model.floor_seen);
  EXPECT_NE(model.note.find("no floor was seen"), std::string::npos) << model.note;
  ASSERT_FALSE(model.body.triangles.empty());
  const Isometry3d world_from_model = scan.world_from_sensor[60] * model.model_from_frame[60].inverse();
  EXPECT_LT(median_error_m(model.body, world_from_model, bust), 0.008);
}

class EveryFuse : public testing::TestWithParam<std::string> {};

TEST_P(EveryFuse, BodyOfAWalkRound) {
  const SensorCalibration calibration = test_scene::kinect(0.25, -0.015);
  const BodyModel model = Fuse::at(GetParam()).run(noisy_scan().scan, calibration, {}, 1);
  EXPECT_TRUE(model.converged);
  EXPECT_EQ(model.frames_used, 120);
  ASSERT_EQ(model.model_from_frame.size(), 120u);
  const bool best = GetParam() == "pose_graph";
  const PoseErrors errors = pose_errors(model.model_from_frame, noisy_scan().world_from_sensor);
  EXPECT_LT(errors.largest_m, best ? 0.003 : 0.03);
  EXPECT_LT(errors.largest_deg, best ? 0.3 : 2.0);
  const Isometry3d world_from_model = noisy_scan().world_from_sensor[60] * model.model_from_frame[60].inverse();
  EXPECT_LT(median_error_m(model.body, world_from_model, test_scene::standing_figure()), best ? 0.002 : 0.006);
  EXPECT_LT(kDegrees * std::acos((world_from_model.linear() * Vector3d::UnitY()).y()), best ? 0.15 : 1);  // gravity
  EXPECT_LT(std::abs(world_from_model.translation().y()), best ? 0.002 : 0.02);                           // floor y = 0
  EXPECT_LT((world_from_model * Vector3d(0, 0, 0)).norm(), 0.05);                                         // axis
  EXPECT_TRUE(topology(model.body).closed());
  EXPECT_EQ(topology(model.body).components, 1);
  EXPECT_GT(model.surroundings.points.size(), 10000u);
}

TEST_P(EveryFuse, SameBytesWithOneAndTwoThreads) {
  const SensorCalibration calibration = test_scene::kinect(0.25, -0.015);
  DepthScan scan = noisy_scan().scan;
  scan.depth_mm.resize(20);
  std::vector<BodyModel> models;
  for (const std::size_t threads : {1, 2, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    models.push_back(Fuse::at(GetParam()).run(scan, calibration, kCoarseBody, 1));
  }
  EXPECT_FALSE(models[0].body.triangles.empty());
  for (const int again : {1, 2}) {
    EXPECT_EQ(models[again].body.vertices, models[0].body.vertices) << again;
    EXPECT_EQ(models[again].body.triangles, models[0].body.triangles) << again;
    EXPECT_EQ(models[again].surroundings.points, models[0].surroundings.points) << again;
    for (std::size_t i = 0; i < 20; ++i)
      EXPECT_EQ(models[again].model_from_frame[i].matrix(), models[0].model_from_frame[i].matrix()) << again;
  }
}

TEST_P(EveryFuse, DroppedFramesHaveNoPose) {
  const SensorCalibration calibration = test_scene::kinect(0.25, -0.015);
  DepthScan scan = noisy_scan().scan;
  scan.depth_mm.resize(30);
  scan.depth_mm[11] = scan.depth_mm[12] = cv::Mat::zeros(scan.depth_mm[0].size(), CV_16U);
  const BodyModel model = Fuse::at(GetParam()).run(scan, calibration, kCoarseBody, 1);
  EXPECT_EQ(model.frames_used, 28);
  EXPECT_FALSE(model.model_from_frame[11].matrix().allFinite());
  EXPECT_TRUE(model.model_from_frame[13].matrix().allFinite());
}

TEST_P(EveryFuse, RefusesAScanWithoutDepth) {
  const SensorCalibration calibration = test_scene::kinect(0.25);
  DepthScan scan;
  scan.sensor = "handheld";
  EXPECT_THROW(Fuse::at(GetParam()).run(scan, calibration, {}, 1), InputError);
  scan.depth_mm.assign(40, cv::Mat::zeros(calibration.ir.height, calibration.ir.width, CV_16U));
  EXPECT_THROW(Fuse::at(GetParam()).run(scan, calibration, {}, 1), InputError);
  scan.depth_mm.assign(40, cv::Mat::zeros(7, 9, CV_16U));
  EXPECT_THROW(Fuse::at(GetParam()).run(scan, calibration, {}, 1), InputError);
}

INSTANTIATE_TEST_SUITE_P(Variants, EveryFuse, testing::ValuesIn(Fuse::automatic_names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace dressform
