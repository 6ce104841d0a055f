#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "synthetic/sensors/kinect_v2_scenes.h"

// The figures of sensors.md and of Fankhauser et al. 2015, one test a line.
namespace dressform {
namespace {

using namespace kinect_v2_scenes;

constexpr float white = kWhiteAlbedo;

DepthErrors of_plane(double distance_m, double tilt_deg, float albedo, const FieldValues& values = noise_only_v2()) {
  return dressform::of_plane(v2_setup(values), distance_m, tilt_deg, albedo);
}

// All that the other tests stand on: what is switched off is all there is to switch off.
TEST(KinectV2, ParametersOfTheMeasurements) {
  EXPECT_EQ(noise_only_v2().size(), 5u);
  EXPECT_EQ(noiseless_v2().size(), 8u);
}

TEST(KinectV2, SigmaAtOneMetre) { EXPECT_NEAR(of_plane(1, 0, white).sigma_mm, 1.30, 0.15 * 1.30); }
TEST(KinectV2, SigmaAtTwoMetres) { EXPECT_NEAR(of_plane(2, 0, white).sigma_mm, 1.70, 0.15 * 1.70); }
TEST(KinectV2, SigmaAtThreeMetres) { EXPECT_NEAR(of_plane(3, 0, white).sigma_mm, 2.70, 0.15 * 2.70); }
TEST(KinectV2, SigmaAtFourMetres) { EXPECT_NEAR(of_plane(4, 0, white).sigma_mm, 4.30, 0.15 * 4.30); }
TEST(KinectV2, SigmaAtSixtyDegrees) { EXPECT_NEAR(of_plane(2, 60, white).sigma_mm, 2.83, 0.25 * 2.83); }
TEST(KinectV2, SigmaAtSeventyDegrees) { EXPECT_NEAR(of_plane(2, 70, white).sigma_mm, 5.16, 0.25 * 5.16); }
TEST(KinectV2, SigmaAtEightyDegrees) { EXPECT_NEAR(of_plane(2, 80, white).sigma_mm, 19.8, 0.25 * 19.8); }

TEST(KinectV2, SigmaByAlbedo) {
  EXPECT_NEAR(of_plane(2.1, 0, 0.40f).sigma_mm, 3.3, 0.15 * 3.3);
  EXPECT_NEAR(of_plane(2.1, 0, 0.20f).sigma_mm, 5.6, 0.15 * 5.6);
  EXPECT_NEAR(of_plane(2.1, 0, 0.12f).sigma_mm, 9.3, 0.15 * 9.3);
  EXPECT_NEAR(of_plane(2.1, 0, 0.05f).sigma_mm, 28, 0.25 * 28);
}

TEST(KinectV2, SigmaWithoutFilterIsThreeTimesAsLarge) {
  const double filtered = of_plane(2, 0, white).sigma_mm;
  const double raw = of_plane(2, 0, white, noise_only_v2({{"bilateral", false}, {"edge_filter", false}})).sigma_mm;
  EXPECT_NEAR(raw / filtered, 3, 0.3);
}

TEST(KinectV2, NoiseAutocorrelation) {
  const auto correlation = noise_autocorrelation(v2_setup(), 3);
  EXPECT_NEAR(correlation[1], 0.68, 0.05);
  EXPECT_NEAR(correlation[2], 0.31, 0.05);
  EXPECT_NEAR(correlation[3], 0.0, 0.06);
}

TEST(KinectV2, HolesByAlbedoFacing) {
  EXPECT_NEAR(of_plane(2.1, 0, 0.05f).holes, 0.02, 0.02);
  EXPECT_LE(of_plane(2.1, 0, 0.12f).holes, 0.001);
  EXPECT_LE(of_plane(2.1, 0, 0.20f).holes, 0.0);
}
TEST(KinectV2, HolesByAlbedoAtSixtyDegrees) {
  EXPECT_NEAR(of_plane(2.1, 60, 0.05f).holes, 0.46, 0.07);
  EXPECT_NEAR(of_plane(2.1, 60, 0.12f).holes, 0.005, 0.01);
  EXPECT_LE(of_plane(2.1, 60, 0.20f).holes, 0.002);
}
TEST(KinectV2, HolesByAlbedoAtSeventyFiveDegrees) {
  EXPECT_NEAR(of_plane(2.1, 75, 0.05f).holes, 0.90, 0.05);
  EXPECT_NEAR(of_plane(2.1, 75, 0.12f).holes, 0.26, 0.06);
  EXPECT_NEAR(of_plane(2.1, 75, 0.20f).holes, 0.02, 0.02);
}

TEST(KinectV2, NoiselessDecodingIsExactOverTheWholeRange) {
  for (double distance_m = 0.5; distance_m <= 4.5; distance_m += 0.125) {
    const DepthErrors errors =
        decoding_errors(v2_setup(noiseless_v2({{"minimum_m", 0.4}, {"maximum_m", 4.6}})), distance_m);
    EXPECT_LE(errors.worst_mm, 0.52) << distance_m;
    EXPECT_EQ(errors.holes, 0) << distance_m;
  }
}

TEST(KinectV2, NoiselessDecodingOfASlantedPlane) {
  const SensorFrame frame = shoot_v2(scene_of(plane(2, 50, 0.8f)), noiseless_v2());
  const Camera camera = full_size_v2();
  for (int y = 20; y < 404; y += 7)
    for (int x = 20; x < 492; x += 5) {
      const double expected_mm = 1000 * true_depth(camera, x, y, 2, 50);
      const int measured = frame.depth_mm.at<std::uint16_t>(y, x);
      if (expected_mm > 505 && expected_mm < 3500) {
        ASSERT_NEAR(measured, expected_mm, 1.0) << x << " " << y;  // the filter takes the mean of nine pixels
      }
    }
}

TEST(KinectV2, FlyingPixelsAtAWideGap) {
  const double flying = flying_pixels(v2_setup(), 2.1);
  EXPECT_GE(flying, 0.01);
  EXPECT_LE(flying, 0.24);
}
TEST(KinectV2, FlyingPixelsAtANarrowGap) {
  for (const double gap_m : {0.2, 0.25, 0.3}) {
    const double flying = flying_pixels(v2_setup(), gap_m);
    EXPECT_GE(flying, 0.2) << gap_m;
    EXPECT_LE(flying, 1.4) << gap_m;
  }
}

// The mean depth error over distance repeats every 3.125 m.
TEST(KinectV2, WigglingByClip) {
  const auto wiggle = [](double clip) { return peak_to_peak(wiggle_mm(v2_setup(noiseless_v2({{"clip", clip}})))); };
  EXPECT_LE(wiggle(1.0), 1.0);  // millimetres are whole
  EXPECT_NEAR(wiggle(0.9), 2.6, 1.0);
  EXPECT_NEAR(wiggle(0.8), 7.7, 1.0);
  EXPECT_NEAR(wiggle(0.7), 11.9, 1.0);
}

TEST(KinectV2, InterferenceByLeak) {
  const double expected_mm[][2] = {{0.02, 3}, {0.05, 7}, {0.10, 13}, {0.20, 27}};
  const RayScene scene = scene_of(plane(2, 0, white));
  for (const auto& [leak, expected] : expected_mm) {
    double squares = 0;
    constexpr int frames = 60;
    for (Seed seed = 1; seed <= frames; ++seed) {
      const SensorFrame frame =
          measure(scene, "kinect_v2", noiseless_v2({{"interference_chance", 1.0}, {"interference_leak", leak}}), seed);
      squares += std::pow(frame.depth_mm.at<std::uint16_t>(106, 128) - 2000.0, 2);
    }
    EXPECT_NEAR(std::sqrt(squares / frames), expected, 0.25 * expected) << leak;
  }
}

TEST(KinectV2, InterferenceIsSeldom) {
  const RayScene scene = scene_of(plane(2, 0, white));
  int disturbed = 0;
  for (Seed seed = 1; seed <= 200; ++seed) {
    const SensorFrame frame =
        measure(scene, "kinect_v2", noiseless_v2({{"interference_chance", 0.1}, {"interference_leak", 0.2}}), seed, 0,
                Camera{16, 16, 366, 366, 7.5, 7.5, {}});
    disturbed += frame.depth_mm.at<std::uint16_t>(8, 8) != 2000;
  }
  EXPECT_GE(disturbed, 8);
  EXPECT_LE(disturbed, 34);
}

TEST(KinectV2, WarmUpFadesInHalfAnHour) {
  const RayScene scene = scene_of(plane(2, 0, white));
  const auto depth = [&](double minutes) {
    const SensorFrame frame = measure(scene, "kinect_v2", noiseless_v2({{"warm_up_mm", 5.0}, {"minutes_on", minutes}}));
    return static_cast<int>(frame.depth_mm.at<std::uint16_t>(106, 128));
  };
  EXPECT_EQ(depth(0), 2005);
  EXPECT_EQ(depth(10), 2002);
  EXPECT_EQ(depth(30), 2000);
}

TEST(KinectV2, OffsetBelongsToTheDevice) {
  const RayScene scene = scene_of(plane(2, 0, white));
  const Camera camera = kinect();
  const RayTable rays(camera);
  const FieldValues values = noiseless_v2({{"offset_mm", -15.0}, {"offset_sigma_mm", 5.0}});
  std::vector<double> offsets;
  for (std::uint64_t device = 0; device < 40; ++device) {
    const IrView view(scene, rays, camera, Isometry3d::Identity(), 0, false, device);
    const int first = SensorModel::at("kinect_v2").run(view, values, 1).depth_mm.at<std::uint16_t>(106, 128);
    const int second = SensorModel::at("kinect_v2").run(view, values, 2).depth_mm.at<std::uint16_t>(106, 128);
    EXPECT_EQ(first, second) << device;
    offsets.push_back(first - 2000.0);
  }
  cv::Scalar mean, sigma;
  cv::meanStdDev(cv::Mat(offsets), mean, sigma);
  EXPECT_NEAR(mean[0], -15, 2.5);
  EXPECT_NEAR(sigma[0], 5, 1.5);
}

TEST(KinectV2, AmbientLightAddsNoiseAndNoBias) {
  const DepthErrors dark = of_plane(3, 0, white), bright = of_plane(3, 0, white, noise_only_v2({{"ambient", 1000.0}}));
  EXPECT_GT(bright.sigma_mm, 1.5 * dark.sigma_mm);
  EXPECT_NEAR(bright.mean_mm, dark.mean_mm, 1.0);
}

TEST(KinectV2, ChromeIsAHoleAndItsGlintSaturates) {
  RaySurface chrome = plane(2.1, 0);
  chrome.material.chrome = true;
  const SensorFrame frame = shoot_v2(scene_of(std::move(chrome)), {});
  EXPECT_EQ(frame.ir.at<std::uint16_t>(212, 256), 65535);
  EXPECT_EQ(frame.depth_mm.at<std::uint16_t>(212, 256), 0);
  EXPECT_LE(cv::countNonZero(frame.depth_mm), 0.05 * 512 * 424);
}

TEST(KinectV2, InfraredDoesNotKnowTheVisibleColour) {
  RaySurface black = plane(2, 0, 0.6f), white_wall = plane(2, 0, 0.6f);
  black.material.albedo_rgb = Vector3f::Constant(0.02f);
  white_wall.material.albedo_rgb = Vector3f::Constant(0.9f);
  const SensorFrame a = shoot_v2(scene_of(std::move(black)), {}), b = shoot_v2(scene_of(std::move(white_wall)), {});
  EXPECT_EQ(cv::norm(a.ir, b.ir, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(a.depth_mm, b.depth_mm, cv::NORM_INF), 0);
}

TEST(KinectV2, BorderPixelsAndOddSizes) {
  const RayScene scene = scene_of(plane(2, 0, white));
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {17, 5}, {130, 61}}) {
    const Camera camera{width, height, 366, 366, 0.5 * (width - 1), 0.5 * (height - 1), {}};
    const SensorFrame frame = measure(scene, "kinect_v2", noiseless_v2(), 1, 0, camera);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) EXPECT_NEAR(frame.depth_mm.at<std::uint16_t>(y, x), 2000, 1);
  }
}

// In the phase domain noise passes the driver's thresholds now and then.
TEST(KinectV2, WhereNothingIsHardlyAPixelHasDepth) {
  const SensorFrame frame = shoot_v2(RayScene(std::vector<RaySurface>{}), {});
  EXPECT_LE(cv::countNonZero(frame.depth_mm), 512 * 424 / 200);
}

}  // namespace
}  // namespace dressform
