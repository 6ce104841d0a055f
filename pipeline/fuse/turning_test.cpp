#include "pipeline/fuse/turning.h"

#include <gtest/gtest.h>

#include "pipeline/fuse/fuse.h"
#include "pipeline/testing/fuse_scans.h"

namespace dressform {
namespace {

using namespace fuse_test;
using test_scene::Figure;
using test_scene::Scan;

// A sensor that stands still before a figure that turns: seen from the figure, the sensor walks and the room turns.
Scan turning_figure(int frames, double turn_deg, double noise) {
  const SensorCalibration calibration = test_scene::kinect(0.25);
  const cv::Mat rays = normalized_grid(calibration.ir);
  Scan result;
  result.scan.sensor = "handheld";
  Figure room = test_scene::standing_figure();
  room.parts.clear();
  room.wall_m = 1.6;
  const Isometry3d eye = test_scene::looking_at({0, 1.15, 1.55}, {0, 0.95, 0});  // in the room, the wall 3.1 m away
  const cv::Mat still = test_scene::depth_image(room, calibration, rays, eye, 0, 1);
  for (int i = 0; i < frames; ++i) {
    const Isometry3d figure_from_room(Eigen::AngleAxisd(turn_deg * M_PI / 180 * i / (frames - 1), Vector3d::UnitY()));
    Figure alone = test_scene::standing_figure();
    alone.wall_m = 0;
    alone.floor = false;
    result.world_from_sensor.push_back(figure_from_room * eye);
    cv::Mat depth = test_scene::depth_image(alone, calibration, rays, result.world_from_sensor.back(), noise, 100 + i);
    for (int y = 0; y < depth.rows; ++y)
      for (int x = 0; x < depth.cols; ++x) {
        auto& z = depth.at<std::uint16_t>(y, x);
        const int wall = still.at<std::uint16_t>(y, x);
        if (wall > 0 && (z == 0 || wall < z))
          z = static_cast<std::uint16_t>(wall + std::lround(noise * normal4(9, i, y * depth.cols + x)[0]));
      }
    result.scan.depth_mm.push_back(depth);
  }
  return result;
}

TEST(Turning, WhoTurnsBeforeAWallIsTheBody) {
  const SensorCalibration calibration = test_scene::kinect(0.25);
  const Scan scan = turning_figure(120, 370, 1);
  const auto limit_m = depth_of_moving(scan.scan, calibration);
  ASSERT_TRUE(limit_m);
  EXPECT_GT(*limit_m, 1.7);
  EXPECT_LT(*limit_m, 2.6);
  const BodyModel model = Fuse::at("pose_graph").run(scan.scan, calibration, {}, 1);
  EXPECT_TRUE(model.converged) << model.note;
  EXPECT_GT(model.turned_deg, 330);
  EXPECT_NE(model.note.find("that was taken for the body"), std::string::npos) << model.note;
  const Isometry3d world_from_model = scan.world_from_sensor[60] * model.model_from_frame[60].inverse();
  EXPECT_LT(median_error_m(model.body, world_from_model, test_scene::standing_figure()), 0.008);
}

TEST(Turning, WhereNothingTurnedThatIsSaid) {
  const SensorCalibration calibration = test_scene::kinect(0.25);
  const Scan scan = test_scene::walk_round(test_scene::standing_figure(), calibration, 20, 7, 1, 3);
  EXPECT_FALSE(depth_of_moving(scan.scan, calibration));
  const BodyModel model = Fuse::at("pose_graph").run(scan.scan, calibration, kCoarseBody, 1);
  EXPECT_FALSE(model.converged);
  EXPECT_NEAR(model.turned_deg, 7, 3);
  EXPECT_NE(model.note.find("nothing turned"), std::string::npos) << model.note;
}

TEST(Turning, AWalkRoundIsAWalkRound) {
  EXPECT_FALSE(depth_of_moving(noisy_scan().scan, test_scene::kinect(0.25, -0.015)));
}

}  // namespace
}  // namespace dressform
