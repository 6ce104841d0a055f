#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "scenes/testing/variant_files.h"
#include "synthetic/sensors/noise_statistics.h"
#include "synthetic/sensors/test_scenes.h"

namespace dressform {
namespace {

using namespace test_scenes;

// RMS of the error in a window about the image centre, millimetres.
double rms_mm(const SensorFrame& frame, double distance_m, double tilt_deg, int half) {
  const Camera camera = kinect();
  double sum = 0;
  int count = 0;
  for (int y = 106 - half; y < 106 + half; ++y)
    for (int x = 128 - half / 2; x < 128 + half / 2; ++x) {
      const int measured = frame.depth_mm.at<std::uint16_t>(y, x);
      if (measured == 0) continue;
      const double error = measured - 1000 * true_depth(camera, x, y, distance_m, tilt_deg);
      sum += error * error;
      ++count;
    }
  return std::sqrt(sum / count);
}

TEST(Sensors, RegisteredModelsAreTheFiles) {
  const auto files = variant_files(std::string(DRESSFORM_SOURCE_DIR) + "/synthetic/sensors");
  EXPECT_THAT(SensorModel::names(), testing::ElementsAreArray(files));
  EXPECT_NO_THROW(SensorModel::at(SensorModel::default_variant()));
}

TEST(Sensors, UnknownModelAndParameterAreInputErrors) {
  EXPECT_THROW(SensorModel::at("sonar"), InputError);
  EXPECT_THROW(SensorModel::at("ideal").complete({{"minimum", 1.0}}), InputError);
  EXPECT_THROW(SensorModel::at("fankhauser").complete({{"noise_scale", -1.0}}), InputError);
}

TEST(Sensors, IdealPlaneIsExact) {
  for (const double distance_m : {0.6, 1.0, 2.1, 4.4}) {
    const SensorFrame frame = measure(scene_of(plane(distance_m, 0)), "ideal");
    for (int y = 0; y < frame.depth_mm.rows; ++y)
      for (int x = 0; x < frame.depth_mm.cols; ++x)
        ASSERT_EQ(frame.depth_mm.at<std::uint16_t>(y, x), std::lround(1000 * distance_m)) << x << " " << y;
  }
}

TEST(Sensors, IdealSlantedPlaneFollowsTheDistortedRays) {
  const SensorFrame frame = measure(scene_of(plane(2, 50)), "ideal");
  const Camera camera = kinect();
  for (int y = 0; y < frame.depth_mm.rows; y += 7)
    for (int x = 0; x < frame.depth_mm.cols; x += 5) {
      const double expected_m = true_depth(camera, x, y, 2, 50);
      if (expected_m > 0.5 && expected_m < 4.5) {
        ASSERT_NEAR(frame.depth_mm.at<std::uint16_t>(y, x), 1000 * expected_m, 0.501 + 1e-3);
      } else {
        ASSERT_EQ(frame.depth_mm.at<std::uint16_t>(y, x), 0);
      }
    }
}

TEST(Sensors, OffsetIsAddedAndRangeEnds) {
  for (const std::string model : {"ideal", "fankhauser"}) {
    const FieldValues values = model == "ideal" ? FieldValues{} : FieldValues{{"noise_scale", 0.0}};
    EXPECT_EQ(measure(scene_of(plane(2, 0)), model, values, 1, 0.018).depth_mm.at<std::uint16_t>(106, 128), 2018);
    EXPECT_EQ(measure(scene_of(plane(0.4, 0)), model, values).depth_mm.at<std::uint16_t>(106, 128), 0);
    EXPECT_EQ(measure(scene_of(plane(4.7, 0)), model, values).depth_mm.at<std::uint16_t>(106, 128), 0);
  }
}

TEST(Sensors, FankhauserSigmaFacing) {
  const double expected_mm[] = {1.30, 1.70, 2.70, 4.30};  // sensors.md at 1, 2, 3, 4 m
  for (int metres = 1; metres <= 4; ++metres) {
    const RayScene scene = scene_of(plane(metres, 0, 0.9f));
    const double rms = rms_mm(measure(scene, "fankhauser"), metres, 0, 30);
    EXPECT_NEAR(std::sqrt(rms * rms - 1.0 / 12), expected_mm[metres - 1], 0.15 * expected_mm[metres - 1]) << metres;
  }
}

TEST(Sensors, FankhauserSigmaAtSixtyDegrees) {
  const RayScene scene = scene_of(plane(2, 60, 0.9f));
  EXPECT_NEAR(rms_mm(measure(scene, "fankhauser"), 2, 60, 16), 2.83, 0.25 * 2.83);
}

TEST(Sensors, NeighboursShareNoiseAsTheDriverLeavesIt) {
  const SensorFrame frame = measure(scene_of(plane(3, 0, 0.9f)), "fankhauser");
  double sums[4] = {};
  for (int y = 60; y < 150; ++y)
    for (int x = 60; x < 190; ++x)
      for (int lag = 0; lag < 4; ++lag)
        sums[lag] +=
            (frame.depth_mm.at<std::uint16_t>(y, x) - 3000.0) * (frame.depth_mm.at<std::uint16_t>(y, x + lag) - 3000.0);
  EXPECT_NEAR(sums[1] / sums[0], 0.67, 0.1);
  EXPECT_NEAR(sums[2] / sums[0], 0.33, 0.1);
  EXPECT_NEAR(sums[3] / sums[0], 0.0, 0.1);
}

TEST(Sensors, SphereSilhouette) {
  for (const std::string model : {"ideal", "fankhauser"}) {
    const RayScene scene = scene_of(surface(sphere_mesh({0, 0, 2}, 0.3, 120), 0.6f, true));
    const SensorFrame frame = measure(scene, model);
    const Camera camera = kinect();
    const double rim = std::asin(0.3 / 2.0);
    int wrong = 0;
    for (int y = 0; y < frame.depth_mm.rows; ++y)
      for (int x = 0; x < frame.depth_mm.cols; ++x) {
        const Vector2d ideal = camera.normalized({static_cast<double>(x), static_cast<double>(y)});
        const double angle = std::atan(ideal.norm()), pixel = 1 / camera.fx;
        const bool seen = frame.depth_mm.at<std::uint16_t>(y, x) != 0;
        // Near the rim fankhauser has mixed pixels and holes at grazing incidence.
        const double band = model == "ideal" ? 0.5 * pixel : 4 * pixel;
        if (angle < rim - band) wrong += !seen;
        if (angle > rim + band) wrong += seen;
      }
    EXPECT_LE(wrong, model == "ideal" ? 0 : 4) << model;
    EXPECT_NEAR(frame.depth_mm.at<std::uint16_t>(106, 128), 1700, 8) << model;
  }
}

// Flying pixels of a plate with slanted edges, `gap_m` before a wall, per contour pixel; `lost`: holes, likewise.
struct Contour {
  double flying = 0, lost = 0;
};
Contour contour_of_plate(double gap_m) {
  std::vector<RaySurface> surfaces;
  surfaces.push_back(plane(2 + gap_m, 0));
  surfaces.push_back(surface(grid_mesh({-0.4, -0.6, 2}, {1, 0.2, 0}, {-0.2, 1, 0}, 1), 0.6f));
  const RayScene scene(std::move(surfaces));
  Contour sum;
  for (Seed seed = 1; seed <= 4; ++seed) {
    const SensorFrame frame = measure(scene, "fankhauser", {}, seed);
    for (int y = 80; y < 130; ++y)
      for (int x = 0; x < frame.depth_mm.cols; ++x) {
        const int depth = frame.depth_mm.at<std::uint16_t>(y, x);
        sum.lost += (depth == 0) / 400.0;  // 50 rows, two edges, four frames
        sum.flying += (depth > 2025 && depth < 1975 + 1000 * gap_m) / 400.0;
      }
  }
  return sum;
}

TEST(Sensors, EdgesMixAndFewMixturesSurviveAWideGap) {
  const Contour wide = contour_of_plate(2.1), narrow = contour_of_plate(0.25);
  EXPECT_GE(wide.flying, 0.01);  // sensors.md
  EXPECT_LE(wide.flying, 0.24);
  EXPECT_GE(narrow.flying, 0.2);
  EXPECT_LE(narrow.flying, 1.4);
  EXPECT_GT(wide.lost, narrow.lost);
}

TEST(Sensors, DarkClothAndChromeGiveHoles) {
  const auto holes = [](RaySurface wall) {
    const SensorFrame frame = measure(scene_of(std::move(wall)), "fankhauser");
    return 1 - static_cast<double>(cv::countNonZero(frame.depth_mm(cv::Rect(100, 80, 56, 52)))) / (56 * 52);
  };
  EXPECT_LT(holes(plane(2.1, 0, 0.4f)), 0.001);
  EXPECT_NEAR(holes(plane(2.1, 0, 0.05f)), 0.02, 0.02);
  EXPECT_NEAR(holes(plane(2.1, 60, 0.05f)), 0.46, 0.15);
  RaySurface chrome = plane(2.1, 20);
  chrome.material.chrome = true;
  EXPECT_GT(holes(std::move(chrome)), 0.9);
}

TEST(Sensors, InfraredFallsWithDistanceAndAngle) {
  const auto brightness = [](double distance_m, double tilt_deg, float albedo) {
    return cv::mean(measure(scene_of(plane(distance_m, tilt_deg, albedo)), "ideal").ir(cv::Rect(124, 102, 8, 8)))[0];
  };
  EXPECT_NEAR(brightness(1, 0, 0.5f) / brightness(2, 0, 0.5f), 4, 0.02);
  EXPECT_NEAR(brightness(2, 60, 0.5f) / brightness(2, 0, 0.5f), 0.5, 0.02);
  EXPECT_NEAR(brightness(2, 0, 0.8f) / brightness(2, 0, 0.4f), 2, 0.02);
}

TEST(Sensors, EveryModelGivesTheSameBytesForAnyThreadCount) {
  std::vector<RaySurface> surfaces;
  surfaces.push_back(plane(4, 30));
  surfaces.push_back(surface(sphere_mesh({0, 0, 2}, 0.5, 60), 0.4f, true));
  const RayScene scene(std::move(surfaces));
  for (const auto& model : SensorModel::names()) {
    SensorFrame frames[2];
    for (int threads = 1; threads <= 2; ++threads) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      frames[threads - 1] = measure(scene, model, {}, 5, 0, Camera{256, 192, 183, 183, 127.5, 95.5, {}});
    }
    EXPECT_EQ(cv::norm(frames[0].depth_mm, frames[1].depth_mm, cv::NORM_INF), 0) << model;
    EXPECT_EQ(cv::norm(frames[0].ir, frames[1].ir, cv::NORM_INF), 0) << model;
  }
}

TEST(Sensors, EveryModelSurvivesAnEmptyWorld) {
  const RayScene nothing(std::vector<RaySurface>{});
  for (const auto& model : SensorModel::names()) {
    const SensorFrame frame =
        measure(nothing, model, without_noise(model), 1, 0, Camera{256, 192, 183, 183, 127.5, 95.5, {}});
    EXPECT_EQ(cv::countNonZero(frame.depth_mm), 0) << model;
  }
}

TEST(Sensors, SeedsDiffer) {
  const RayScene scene = scene_of(plane(2, 0));
  const SensorFrame a = measure(scene, "fankhauser", {}, 1), b = measure(scene, "fankhauser", {}, 2);
  EXPECT_GT(cv::norm(a.depth_mm, b.depth_mm, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace dressform
