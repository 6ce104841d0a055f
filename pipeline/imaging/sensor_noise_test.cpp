#include "pipeline/imaging/sensor_noise.h"

#include <gtest/gtest.h>

#include "pipeline/imaging/depth_map.h"
#include "pipeline/testing/test_scene.h"

namespace dressform {
namespace {

const Isometry3d kPose = test_scene::looking_at({0, 1.25, 2.1}, {0, 0.95, 0});

// The standing figure in its room, with so many times the usual noise.
cv::Mat room(const SensorCalibration& sensor, double noise, std::uint64_t seed = 3) {
  return test_scene::depth_image(test_scene::standing_figure(), sensor, normalized_grid(sensor.ir), kPose, noise, seed);
}

TEST(DepthNoiseFactor, IsThatOfTheImage) {
  for (const double scale : {0.5, 1.0}) {
    const SensorCalibration sensor = test_scene::kinect(scale);
    for (const double noise : {1.0, 2.0})  // a dark wall before a usual sensor does as much
      EXPECT_EQ(depth_noise_factor({room(sensor, noise)}, sensor.ir), 1) << scale;
    for (const double noise : {4.0, 6.0})
      EXPECT_NEAR(depth_noise_factor({room(sensor, noise)}, sensor.ir), noise, 0.1 * noise) << scale;
  }
}

TEST(DepthNoiseFactor, IsOneWhereNothingTells) {
  const SensorCalibration sensor = test_scene::kinect(0.5);
  EXPECT_EQ(depth_noise_factor({}, sensor.ir), 1);
  EXPECT_EQ(depth_noise_factor({cv::Mat(), cv::Mat(8, 8, CV_16U, cv::Scalar(1000))}, sensor.ir), 1);
  EXPECT_EQ(depth_noise_factor({room(sensor, 0)}, sensor.ir), 1) << "better than the curve";
  test_scene::Figure alone = test_scene::standing_figure();
  alone.floor = false, alone.wall_m = 0;
  const cv::Mat image = test_scene::depth_image(alone, sensor, normalized_grid(sensor.ir), kPose, 4, 3);
  EXPECT_EQ(depth_noise_factor({image}, sensor.ir), 1) << "no window of a body is smooth";
}

TEST(DepthNoiseFactor, NoisyDepthKeepsItsPixelsAndSaysItsNoise) {
  const SensorCalibration sensor = test_scene::kinect(0.5);
  DepthMapOptions options;
  const DepthMap usual = make_depth_map(room(sensor, 1), sensor, options);
  const cv::Mat noisy = room(sensor, 4);
  options.noise_factor = depth_noise_factor({noisy}, sensor.ir);
  const DepthMap judged = make_depth_map(noisy, sensor, options);
  EXPECT_GT(judged.valid, 0.9 * usual.valid);
  // What the map says of its noise is the noise.
  double squares = 0, expected = 0;
  int count = 0;
  const DepthMap exact = make_depth_map(room(sensor, 0), sensor, {});
  for (std::size_t i = 0; i < judged.points.size(); ++i) {
    if (!judged.has_normal(static_cast<int>(i)) || !exact.has_normal(static_cast<int>(i))) continue;
    const double off = exact.normals[i].dot(judged.points[i] - exact.points[i]);
    if (std::abs(off) > 0.1) continue;  // a flying pixel
    squares += off * off, expected += judged.sigma_m[i] * judged.sigma_m[i], ++count;
  }
  ASSERT_GT(count, 5000);
  EXPECT_NEAR(std::sqrt(squares / expected), 1, 0.2);
}

TEST(DepthNoiseFactor, FramesOfAScanAreEvenlySpread) {
  std::vector<cv::Mat> scan;
  for (int i = 0; i < 12; ++i) scan.push_back(cv::Mat(1, 1, CV_16U, cv::Scalar(i)));
  std::vector<int> chosen;
  for (const auto& frame : frames_for_noise(scan)) chosen.push_back(frame.at<std::uint16_t>(0, 0));
  EXPECT_EQ(chosen, (std::vector<int>{1, 3, 5, 7, 9, 11}));
  EXPECT_EQ(frames_for_noise({scan[0], scan[1]}).size(), 2u);
  EXPECT_TRUE(frames_for_noise({}).empty());
}

}  // namespace
}  // namespace dressform
