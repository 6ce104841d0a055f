#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <set>

#include "synthetic/sensors/test_scenes.h"

namespace dressform {
namespace {

using namespace test_scenes;

Camera kinect_v1() { return Camera{640, 480, 580, 580, 319.5, 239.5, {}}; }

SensorFrame shoot(const RayScene& scene, const FieldValues& values = {}, Seed seed = 1) {
  return measure(scene, "kinect_v1", values, seed, 0, kinect_v1());
}

// Every depth that can come out between `from_mm` and `to_mm`: a floor that leads away from the sensor shows them all.
std::set<int> levels(double from_mm, double to_mm) {
  const Vector3d u(0, -0.7, 4.5), v(1, 0, 0);
  RaySurface floor = surface(grid_mesh(Vector3d(-0.5, 0.3, 0.5), v, u, 0.1), 1.0f);
  const SensorFrame frame = shoot(scene_of(std::move(floor)), {{"least_signal", 0.0}});
  std::set<int> result;
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x)
      if (const int z = frame.depth_mm.at<std::uint16_t>(y, x); z >= from_mm && z <= to_mm) result.insert(z);
  return result;
}

TEST(KinectV1, The259LevelsBetweenOneAndFourMetres) {
  std::set<int> expected;
  for (int n = -2000; n < 280; ++n) {
    const double z = std::floor(1.0 / (1.0 / 1200 - n * 0.1042 / 36000));
    if (z >= 1000 && z <= 4000) expected.insert(static_cast<int>(z));
  }
  EXPECT_EQ(expected.size(), 259u);
  EXPECT_EQ(levels(1000, 4000), expected);
}

TEST(KinectV1, StepsGrowWithTheSquareOfTheDistance) {
  const std::set<int> ladder = levels(1000, 4000);
  for (auto low = ladder.begin(), high = std::next(low); high != ladder.end(); ++low, ++high) {
    const double middle = 0.5 * (*low + *high);
    EXPECT_NEAR(*high - *low, middle * middle / 345489, 1.01);  // whole millimetres
  }
}

TEST(KinectV1, KhoshelhamSigma) {
  for (const double metres : {1.0, 1.5, 2.0, 2.5, 3.0, 3.5}) {
    const RayScene scene = scene_of(plane(metres, 0, 0.9f));
    double sum = 0, squares = 0;
    int count = 0;
    for (Seed seed = 1; seed <= 6; ++seed)
      // Distances a part of a step apart, so that the steps' own width counts as it does on average.
      for (const double part : {0.0, 0.25, 0.5, 0.75}) {
        const double z = metres + part * 1e-3 * 1e6 * metres * metres / 345489;
        const SensorFrame frame = shoot(scene_of(plane(z, 0, 0.9f)), {}, seed);
        for (int y = 40; y < 440; y += 2)
          for (int x = 40; x < 600; x += 2) {
            const double error = frame.depth_mm.at<std::uint16_t>(y, x) - 1000 * z;
            sum += error, squares += error * error;
            ++count;
          }
      }
    const double expected_mm = 1.425 * metres * metres, mean = sum / count;
    EXPECT_NEAR(std::sqrt(squares / count - mean * mean), expected_mm, 0.15 * expected_mm) << metres;
    EXPECT_NEAR(mean, -0.5, 0.25 * expected_mm) << metres;  // the ladder's millimetres are floored
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

TEST(KinectV1, InfraredPictureMayLieBesideTheDepth) {
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
