#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "synthetic/sensors/bounce_map.h"
#include "synthetic/sensors/test_scenes.h"

// The figures of sensors.md and of Fankhauser et al. 2015, one test a line.
namespace dressform {
namespace {

using namespace test_scenes;

Camera full_size() { return Camera{512, 424, 366, 366, 255.5, 211.5, {0.09, -0.27, 0, 0, 0.1}}; }

// Noise alone: what moves the mean is off.
FieldValues noise_only(FieldValues more = {}) {
  FieldValues values{
      {"clip", 1.0}, {"multipath", 0.0}, {"interference_chance", 0.0}, {"warm_up_mm", 0.0}, {"ambient", 0.0}};
  for (const auto& [name, value] : more) values[name] = value;
  return values;
}
// What moves the mean, alone.
FieldValues noiseless(FieldValues more = {}) {
  FieldValues values = noise_only({{"noise_scale", 0.0}, {"companding", false}, {"relief", 0.0}});
  for (const auto& [name, value] : more) values[name] = value;
  return values;
}

SensorFrame shoot(const RayScene& scene, const FieldValues& values, Seed seed = 1) {
  return measure(scene, "kinect_v2", values, seed, 0, full_size());
}

struct Statistics {
  double mean_mm = 0, sigma_mm = 0, holes = 0;
};

// Of the error over columns about the image centre where the incidence stays near the plane's tilt.
Statistics statistics(const SensorFrame& frame, double distance_m, double tilt_deg, int half_width, int half_height) {
  const Camera camera = full_size();
  double sum = 0, squares = 0;
  int count = 0, holes = 0;
  for (int y = 212 - half_height; y < 212 + half_height; ++y)
    for (int x = 256 - half_width; x < 256 + half_width; ++x) {
      const int measured = frame.depth_mm.at<std::uint16_t>(y, x);
      holes += measured == 0;
      if (measured == 0) continue;
      const double error = measured - 1000 * true_depth(camera, x, y, distance_m, tilt_deg);
      sum += error, squares += error * error;
      ++count;
    }
  Statistics result;
  result.holes = static_cast<double>(holes) / (count + holes);
  result.mean_mm = sum / std::max(1, count);
  result.sigma_mm = std::sqrt(squares / std::max(1, count) - result.mean_mm * result.mean_mm);
  return result;
}

// The white target of the published measurements.
constexpr float white = 0.95f;

Statistics of_plane(double distance_m, double tilt_deg, float albedo, const FieldValues& values = noise_only()) {
  const int half_width = tilt_deg == 0 ? 24 : 3, half_height = tilt_deg == 0 ? 24 : 60;
  return statistics(shoot(scene_of(plane(distance_m, tilt_deg, albedo)), values), distance_m, tilt_deg, half_width,
                    half_height);
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
  const double raw = of_plane(2, 0, white, noise_only({{"bilateral", false}, {"edge_filter", false}})).sigma_mm;
  EXPECT_NEAR(raw / filtered, 3, 0.3);
}

TEST(KinectV2, NoiseAutocorrelation) {
  const SensorFrame frame = shoot(scene_of(plane(3, 0, white)), noise_only());
  double sums[4] = {};
  for (int y = 190; y < 235; ++y)
    for (int x = 200; x < 300; ++x)
      for (int lag = 0; lag < 4; ++lag)
        sums[lag] +=
            (frame.depth_mm.at<std::uint16_t>(y, x) - 3000.0) * (frame.depth_mm.at<std::uint16_t>(y, x + lag) - 3000.0);
  EXPECT_NEAR(sums[1] / sums[0], 0.68, 0.05);
  EXPECT_NEAR(sums[2] / sums[0], 0.31, 0.05);
  EXPECT_NEAR(sums[3] / sums[0], 0.0, 0.06);
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
    const SensorFrame frame =
        shoot(scene_of(plane(distance_m, 0, 0.8f)), noiseless({{"minimum_m", 0.4}, {"maximum_m", 4.6}}));
    for (int y = 0; y < 424; y += 3)
      for (int x = 0; x < 512; x += 3)
        ASSERT_NEAR(frame.depth_mm.at<std::uint16_t>(y, x), 1000 * distance_m, 0.52)
            << distance_m << " " << x << " " << y;
  }
}

TEST(KinectV2, NoiselessDecodingOfASlantedPlane) {
  const SensorFrame frame = shoot(scene_of(plane(2, 50, 0.8f)), noiseless());
  const Camera camera = full_size();
  for (int y = 20; y < 404; y += 7)
    for (int x = 20; x < 492; x += 5) {
      const double expected_mm = 1000 * true_depth(camera, x, y, 2, 50);
      const int measured = frame.depth_mm.at<std::uint16_t>(y, x);
      if (expected_mm > 505 && expected_mm < 3500) {
        ASSERT_NEAR(measured, expected_mm, 1.0) << x << " " << y;  // the filter takes the mean of nine pixels
      }
    }
}

// Flying pixels of a plate with slanted edges, `gap_m` before a wall, per contour pixel: depths farther from both than
// six sigma of their noise.
double flying_pixels(double gap_m) {
  std::vector<RaySurface> surfaces;
  surfaces.push_back(plane(2 + gap_m, 0));
  surfaces.push_back(surface(grid_mesh({-0.4, -0.6, 2}, {1, 0.2, 0}, {-0.2, 1, 0}, 1), 0.6f));
  const RayScene scene(std::move(surfaces));
  const double before_wall_mm = gap_m > 1 ? 60 : 25;
  double flying = 0;
  for (Seed seed = 1; seed <= 4; ++seed) {
    const SensorFrame frame = shoot(scene, noise_only(), seed);
    for (int y = 160; y < 260; ++y)
      for (int x = 100; x < 412; ++x) {
        const int depth = frame.depth_mm.at<std::uint16_t>(y, x);
        flying += depth > 2025 && depth < 2000 + 1000 * gap_m - before_wall_mm;
      }
  }
  return flying / 800;  // 100 rows, two edges, four frames
}

TEST(KinectV2, FlyingPixelsAtAWideGap) {
  const double flying = flying_pixels(2.1);
  EXPECT_GE(flying, 0.01);
  EXPECT_LE(flying, 0.24);
}
TEST(KinectV2, FlyingPixelsAtANarrowGap) {
  for (const double gap_m : {0.2, 0.25, 0.3}) {
    const double flying = flying_pixels(gap_m);
    EXPECT_GE(flying, 0.2) << gap_m;
    EXPECT_LE(flying, 1.4) << gap_m;
  }
}

// Peak to peak of the mean depth error over distance, which repeats every 3.125 m.
double wiggle_mm(double clip) {
  double least = 1e9, most = -1e9;
  for (double distance_m = 0.7; distance_m <= 4.4; distance_m += 0.06) {
    const Statistics s = of_plane(distance_m, 0, 0.8f, noiseless({{"clip", clip}}));
    least = std::min(least, s.mean_mm), most = std::max(most, s.mean_mm);
  }
  return most - least;
}

TEST(KinectV2, WigglingByClip) {
  EXPECT_LE(wiggle_mm(1.0), 1.0);  // millimetres are whole
  EXPECT_NEAR(wiggle_mm(0.9), 2.6, 1.0);
  EXPECT_NEAR(wiggle_mm(0.8), 7.7, 1.0);
  EXPECT_NEAR(wiggle_mm(0.7), 11.9, 1.0);
}

TEST(KinectV2, InterferenceByLeak) {
  const double expected_mm[][2] = {{0.02, 3}, {0.05, 7}, {0.10, 13}, {0.20, 27}};
  const RayScene scene = scene_of(plane(2, 0, white));
  for (const auto& [leak, expected] : expected_mm) {
    double squares = 0;
    constexpr int frames = 60;
    for (Seed seed = 1; seed <= frames; ++seed) {
      const SensorFrame frame =
          measure(scene, "kinect_v2", noiseless({{"interference_chance", 1.0}, {"interference_leak", leak}}), seed);
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
        measure(scene, "kinect_v2", noiseless({{"interference_chance", 0.1}, {"interference_leak", 0.2}}), seed, 0,
                Camera{16, 16, 366, 366, 7.5, 7.5, {}});
    disturbed += frame.depth_mm.at<std::uint16_t>(8, 8) != 2000;
  }
  EXPECT_GE(disturbed, 8);
  EXPECT_LE(disturbed, 34);
}

TEST(KinectV2, WarmUpFadesInHalfAnHour) {
  const RayScene scene = scene_of(plane(2, 0, white));
  const auto depth = [&](double minutes) {
    const SensorFrame frame = measure(scene, "kinect_v2", noiseless({{"warm_up_mm", 5.0}, {"minutes_on", minutes}}));
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
  const FieldValues values = noiseless({{"offset_mm", -15.0}, {"offset_sigma_mm", 5.0}});
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

TEST(KinectV2, ACornerLooksRoundBecauseOfBouncedLight) {
  // Two bright walls at a right angle, edge at 2.5 m: light that bounced off the other wall came the longer way.
  std::vector<RaySurface> walls;
  walls.push_back(surface(grid_mesh({0, -2, 2.5}, {2, 0, -2}, {0, 4, 0}, 0.1), 0.8f));
  walls.push_back(surface(grid_mesh({0, -2, 2.5}, {0, 4, 0}, {-2, 0, -2}, 0.1), 0.8f));
  const RayScene scene(std::move(walls));
  const auto depth = [&](double strength, int x) {
    const cv::Mat part = shoot(scene, noiseless({{"multipath", strength}})).depth_mm(cv::Rect(x, 192, 1, 40));
    return cv::mean(part)[0];
  };
  for (const int x : {225, 286}) {
    const double longer_mm = depth(1, x) - depth(0, x);
    EXPECT_GT(longer_mm, 5) << x;
    EXPECT_LT(longer_mm, 80) << x;
  }
}

TEST(KinectV2, BouncedLightInASphereIsThatOfTheBooks) {
  // From the centre of a matt sphere: what bounces once lights all of it alike, albedo x cone / (4 pi) of the direct.
  const RayScene scene = scene_of(surface(sphere_mesh({0, 0, 0}, 2, 200), 0.5f, true));
  const Camera camera{512, 424, 366, 366, 255.5, 211.5, {}};
  const RayTable rays(camera);
  const IrView view(scene, rays, camera, Isometry3d::Identity(), 0);
  const BounceMap map(view, 4, 1);
  double cone = 0;
  for (int y = 0; y < 424; ++y)
    for (int x = 0; x < 512; ++x) cone += std::pow(1 + view.ideal(x, y).squaredNorm(), -1.5) / (366.0 * 366.0);
  std::vector<float> terms(512 * tof::bounce_terms);
  for (const int y : {0, 100, 211, 423}) {
    map.row(y, terms.data());
    for (const int x : {0, 200, 256, 511})
      EXPECT_NEAR(terms[512 * (tof::bounce_terms - 1) + x], 0.5 * cone / (4 * M_PI) / 4,
                  0.05 * 0.5 * cone / (16 * M_PI));
  }
}

TEST(KinectV2, APlaneBouncesNoLightOntoItself) {
  const RayScene scene = scene_of(plane(2, 30, 0.8f));
  EXPECT_EQ(cv::norm(shoot(scene, noiseless()).depth_mm, shoot(scene, noiseless({{"multipath", 1.0}})).depth_mm,
                     cv::NORM_INF),
            0);
}

TEST(KinectV2, AmbientLightAddsNoiseAndNoBias) {
  const Statistics dark = of_plane(3, 0, white), bright = of_plane(3, 0, white, noise_only({{"ambient", 1000.0}}));
  EXPECT_GT(bright.sigma_mm, 1.5 * dark.sigma_mm);
  EXPECT_NEAR(bright.mean_mm, dark.mean_mm, 1.0);
}

TEST(KinectV2, ChromeIsAHoleAndItsGlintSaturates) {
  RaySurface chrome = plane(2.1, 0);
  chrome.material.chrome = true;
  const SensorFrame frame = shoot(scene_of(std::move(chrome)), {});
  EXPECT_EQ(frame.ir.at<std::uint16_t>(212, 256), 65535);
  EXPECT_EQ(frame.depth_mm.at<std::uint16_t>(212, 256), 0);
  EXPECT_LE(cv::countNonZero(frame.depth_mm), 0.05 * 512 * 424);
}

TEST(KinectV2, InfraredDoesNotKnowTheVisibleColour) {
  RaySurface black = plane(2, 0, 0.6f), white_wall = plane(2, 0, 0.6f);
  black.material.albedo_rgb = Vector3f::Constant(0.02f);
  white_wall.material.albedo_rgb = Vector3f::Constant(0.9f);
  const SensorFrame a = shoot(scene_of(std::move(black)), {}), b = shoot(scene_of(std::move(white_wall)), {});
  EXPECT_EQ(cv::norm(a.ir, b.ir, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(a.depth_mm, b.depth_mm, cv::NORM_INF), 0);
}

TEST(KinectV2, BorderPixelsAndOddSizes) {
  const RayScene scene = scene_of(plane(2, 0, white));
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {17, 5}, {130, 61}}) {
    const Camera camera{width, height, 366, 366, 0.5 * (width - 1), 0.5 * (height - 1), {}};
    const SensorFrame frame = measure(scene, "kinect_v2", noiseless(), 1, 0, camera);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) EXPECT_NEAR(frame.depth_mm.at<std::uint16_t>(y, x), 2000, 1);
  }
}

}  // namespace
}  // namespace dressform
