#include "synthetic/boards/board.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "synthetic/boards/given_calibration.h"
#include "synthetic/synthesize.h"

namespace dressform {
namespace {

Scene scene_with_boards(int views) {
  Scene scene = read_scene(std::string(DRESSFORM_SOURCE_DIR) + "/scenes/library/group1.toml");
  scene.boards.emplace();
  scene.boards->views = views;
  return scene;
}

TEST(Boards, PosesAreInBothImagesAndVaried) {
  const Scene scene = scene_with_boards(25);
  for (const auto& sensor : scene.rig) {
    const auto poses = board_poses(*scene.boards, sensor, 1);
    ASSERT_EQ(poses.size(), 25u);
    double nearest = 10, farthest = 0, most_tilt = 0, left = 1e9, right = 0, top = 1e9, bottom = 0;
    for (const auto& pose : poses) {
      for (const double x : {-0.168, 0.168})
        for (const double y : {-0.28, 0.28}) {
          const Vector3d corner = pose * Vector3d(x, y, 0);
          ASSERT_TRUE(sensor.calibration.ir.contains(sensor.calibration.ir.project(corner)));
          ASSERT_TRUE(sensor.calibration.color->contains(
              sensor.calibration.color->project(sensor.calibration.color_from_ir * corner)));
        }
      const Vector2d middle = sensor.calibration.ir.project(pose.translation());
      left = std::min(left, middle.x()), right = std::max(right, middle.x());
      top = std::min(top, middle.y()), bottom = std::max(bottom, middle.y());
      nearest = std::min(nearest, pose.translation().z()), farthest = std::max(farthest, pose.translation().z());
      most_tilt = std::max(most_tilt, std::acos(pose.linear()(2, 2)) * 180 / M_PI);
    }
    EXPECT_LT(nearest, 0.95);
    EXPECT_GT(farthest, 1.4);
    EXPECT_GT(most_tilt, 30);
    EXPECT_LE(most_tilt, 40.1);
    EXPECT_GT(right - left, 200);
    EXPECT_GT(bottom - top, 120);
  }
}

TEST(Boards, PosesDependOnSeedAndSensorOnly) {
  const Scene scene = scene_with_boards(5);
  const auto a = board_poses(*scene.boards, scene.rig[0], 3), b = board_poses(*scene.boards, scene.rig[0], 3);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(a[i].matrix() == b[i].matrix());
  EXPECT_FALSE(a[0].matrix() == board_poses(*scene.boards, scene.rig[0], 4)[0].matrix());
}

TEST(Boards, BoardThatFitsNowhereIsAnInputError) {
  Scene scene = scene_with_boards(3);
  scene.boards->square_m = 0.3;
  EXPECT_THROW(board_poses(*scene.boards, scene.rig[0], 1), InputError);
}

TEST(Boards, PatternHasItsSizeAndMargin) {
  const BoardsSpec spec;
  const RaySurface board = make_board(spec, Isometry3d::Identity());
  EXPECT_EQ(board.texture.size(), cv::Size(14 * 32, 22 * 32));
  EXPECT_GT(board.texture.at<cv::Vec3b>(16, 16)[0], 200);  // margin
  EXPECT_LT(board.texture.at<cv::Vec3b>(48, 48)[0], 60);   // first square: dark
  EXPECT_GT(board.texture.at<cv::Vec3b>(48, 80)[0], 200);
  EXPECT_LT(board.texture.at<cv::Vec3b>(20 * 32 + 16, 12 * 32 + 16)[0],
            60);  // the last one too: it looks the same turned
  double width = 0, height = 0;
  for (const auto& v : board.mesh.vertices) width = std::max(width, 2 * v.x()), height = std::max(height, 2 * v.y());
  EXPECT_NEAR(width, 14 * 0.028, 1e-9);
  EXPECT_NEAR(height, 22 * 0.028, 1e-9);
}

// Depth on the board is the plane's, with the sensor's offset.
TEST(Boards, ShotsShowTheBoardWhereItIs) {
  Scene scene = scaled(scene_with_boards(2), 0.25);
  scene.rig.resize(1);
  scene.rig[0].calibration.depth_offset_m = 0.02;
  scene.sensor_model = {"ideal", {}};
  const auto capture = synthesize_boards(scene, 5);
  ASSERT_TRUE(capture.session.boards);
  EXPECT_EQ(capture.session.boards->inner_corners_x, 11);
  EXPECT_EQ(capture.session.boards->inner_corners_y, 19);
  const auto& shots = capture.session.boards->shots.at("k1");
  const auto poses = board_poses(*scene.boards, scene.rig[0], 5);
  ASSERT_EQ(shots.size(), 2u);
  const Camera& ir = scene.rig[0].calibration.ir;
  for (int i = 0; i < 2; ++i) {
    const Vector2d pixel = ir.project(poses[i].translation());
    const int x = static_cast<int>(std::lround(pixel.x())), y = static_cast<int>(std::lround(pixel.y()));
    const Vector2d ideal = ir.normalized(Vector2d(x, y));
    const Vector3d normal = poses[i].linear().col(2);
    const double z = normal.dot(poses[i].translation()) / normal.dot(Vector3d(ideal.x(), ideal.y(), 1));
    EXPECT_NEAR(shots[i].depth_mm.at<std::uint16_t>(y, x), 1000 * z + 20, 1);
    EXPECT_EQ(shots[i].color.cols, scene.rig[0].calibration.color->width);
  }
  EXPECT_EQ(capture.truth.calibration->sensors.at("k1").depth_offset_m, 0.02);
}

TEST(GivenCalibration, IsTrueUnlessTheSceneAsksForErrors) {
  Scene scene = scene_with_boards(2);
  const SensorCalibration& truth = scene.rig[0].calibration;
  const auto exact = given_calibration(scene, 1).sensors.at("k1");
  EXPECT_EQ(exact.ir.fx, truth.ir.fx);
  scene.given_calibration.focal_percent = 1;
  scene.given_calibration.principal_px = 5;
  scene.given_calibration.rotation_deg = 0.3;
  scene.given_calibration.translation_mm = 2;
  scene.given_calibration.depth_offset_mm = 10;
  scene.given_calibration.distortion = false;
  double focal = 0, offset = 0;
  constexpr int kSeeds = 400;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const auto given = given_calibration(scene, seed).sensors.at("k1");
    focal += std::pow(100 * (given.ir.fx / truth.ir.fx - 1), 2) / kSeeds;
    offset += std::pow(1000 * (given.depth_offset_m - truth.depth_offset_m), 2) / kSeeds;
    ASSERT_NEAR(given.ir.fy / given.ir.fx, truth.ir.fy / truth.ir.fx, 1e-12);
    ASSERT_EQ(given.ir.distortion[0], 0);
    ASSERT_NEAR(given.color_from_ir.linear().determinant(), 1, 1e-12);
  }
  EXPECT_NEAR(std::sqrt(focal), 1, 0.15);
  EXPECT_NEAR(std::sqrt(offset), 10, 1.5);
}

}  // namespace
}  // namespace dressform
