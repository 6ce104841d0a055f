#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <set>

#include "scenes/devices/noise.h"
#include "synthetic/sensors/noise_statistics.h"
#include "synthetic/sensors/test_scenes.h"

namespace dressform {
namespace {

using namespace test_scenes;

Camera kinect_v1() { return usual_camera("kinect_v1"); }

SensorFrame shoot(const RayScene& scene, const FieldValues& values = {}, Seed seed = 1) {
  return measure(scene, "kinect_v1", values, seed, 0, kinect_v1());
}

SensorSetup setup() { return {"kinect_v1", {}, kinect_v1()}; }

TEST(KinectV1, The259LevelsBetweenOneAndFourMetres) {
  const std::set<int> expected = device_of("kinect_v1").levels_mm(1000, 4000);
  EXPECT_EQ(expected.size(), 259u);
  EXPECT_EQ(depth_levels(setup(), 1000, 4000), expected);
}

TEST(KinectV1, StepsGrowWithTheSquareOfTheDistance) {
  const std::set<int> ladder = depth_levels(setup(), 1000, 4000);
  for (auto low = ladder.begin(), high = std::next(low); high != ladder.end(); ++low, ++high) {
    const double middle = 0.5 * (*low + *high);
    EXPECT_NEAR(*high - *low, device_of("kinect_v1").step_mm(middle / 1000), 1.01);  // whole millimetres
  }
}

TEST(KinectV1, KhoshelhamSigma) {
  for (const double metres : {1.0, 1.5, 2.0, 2.5, 3.0, 3.5}) {
    const DepthErrors errors = of_plane_between_steps(setup(), metres, 6);
    const double expected_mm = khoshelham_sigma_mm(metres);
    EXPECT_NEAR(errors.sigma_mm, expected_mm, 0.15 * expected_mm) << metres;
    EXPECT_NEAR(errors.mean_mm, -0.5, 0.25 * expected_mm) << metres;  // the ladder's millimetres are floored
    EXPECT_LE(errors.holes, 0) << metres;
  }
}

TEST(KinectV1, TheProjectorCastsAShadowOnOneSide) {
  std::vector<RaySurface> surfaces;
  surfaces.push_back(plane(2.5, 0));
  surfaces.push_back(surface(grid_mesh({-0.15, -0.3, 1.5}, {0.3, 0, 0}, {0, 0.6, 0}, 0.1), 0.6f));
  const SensorFrame frame = shoot(RayScene(std::move(surfaces)), {{"support_px", 1}});
  const auto holes = [&](int from, int to) {
    int count = 0;
    for (int x = from; x < to; ++x) count += frame.depth_mm.at<std::uint16_t>(240, x) == 0;
    return count;
  };
  // The plate's edges are at 320 -+ 58; the shadow is f b (1/1.5 - 1/2.5) = 11.6 px wide.
  EXPECT_NEAR(holes(200, 300), 11.6, 1.5);
  EXPECT_EQ(holes(330, 440), 0);
  const cv::Mat& ir = frame.ir;
  EXPECT_LT(cv::mean(ir(cv::Rect(253, 230, 6, 20)))[0], 0.2 * cv::mean(ir(cv::Rect(230, 230, 10, 20)))[0]);
}

TEST(KinectV1, AWindowWithTooFewDotsHasNoDepth) {
  const RayScene dark = scene_of(plane(3, 0, 0.03f));
  EXPECT_EQ(cv::countNonZero(shoot(dark).depth_mm), 0);
  RaySurface chrome = plane(2, 0);
  chrome.material.chrome = true;
  EXPECT_EQ(cv::countNonZero(shoot(scene_of(std::move(chrome))).depth_mm), 0);
}

TEST(KinectV1, InfraredImageMayLieBesideTheDepth) {
  const RayScene scene = scene_of(plane(2, 0));
  const SensorFrame straight = shoot(scene), moved = shoot(scene, {{"ir_shift_x_px", 5}, {"ir_shift_y_px", 4}});
  const cv::Mat expected = straight.ir(cv::Rect(0, 0, 635, 476)), found = moved.ir(cv::Rect(5, 4, 635, 476));
  EXPECT_EQ(cv::norm(expected, found, cv::NORM_INF), 0);
}

TEST(KinectV1, AnotherCamerasShapeIsAnInputError) {
  const RayScene scene = scene_of(plane(2, 0));
  EXPECT_THROW(measure(scene, "kinect_v1", {}, 1, 0, Camera{512, 424, 366, 366, 256, 212, {}}), InputError);
}

}  // namespace
}  // namespace dressform
