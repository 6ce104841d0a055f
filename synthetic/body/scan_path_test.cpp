#include "synthetic/body/scan_path.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dressform {
namespace {

ScanSpec scan_spec() {
  ScanSpec scan;
  scan.calibration.ir = Camera{512, 424, 365.4, 365.1, 256.8, 207.4, {0.0931, -0.2698, 0, 0, 0.0902}};
  return scan;
}

double degrees_between(const Isometry3d& a, const Isometry3d& b) {
  const Eigen::Quaterniond q(a.linear().transpose() * b.linear());
  return 2 * std::atan2(q.vec().norm(), std::abs(q.w())) * 180 / M_PI;
}

TEST(ScanPath, GoesRoundOnceWithOverlapInSmallSteps) {
  for (Seed seed = 1; seed <= 5; ++seed) {
    const auto path = make_scan_path(scan_spec(), 1.85, seed);
    ASSERT_EQ(path.size(), 120u);
    double turned = 0;
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Vector3d a = path[i - 1].translation(), b = path[i].translation();
      turned += std::remainder(std::atan2(b.x(), b.z()) - std::atan2(a.x(), a.z()), 2 * M_PI);
      EXPECT_LT((b - a).norm(), 0.22);
      EXPECT_LT(degrees_between(path[i - 1], path[i]), 8);
    }
    EXPECT_GT(turned, 2 * M_PI * 1.03);
    EXPECT_LT(turned, 2 * M_PI * 1.15);
  }
}

TEST(ScanPath, KeepsItsDistanceAndStandsUpright) {
  for (Seed seed = 1; seed <= 5; ++seed)
    for (const auto& pose : make_scan_path(scan_spec(), 1.85, seed)) {
      const Vector3d place = pose.translation();
      EXPECT_NEAR(std::hypot(place.x(), place.z()), 1.9, 0.2);
      EXPECT_GT(place.y(), 0.7);
      EXPECT_LT(place.y(), 1.6);
      EXPECT_LT(pose.linear()(1, 1), -0.85);  // image rows run down
      EXPECT_NEAR(pose.linear().determinant(), 1, 1e-9);
    }
}

TEST(ScanPath, HeadFeetAndFloorAreSeenFromManySides) {
  const ScanSpec scan = scan_spec();
  for (Seed seed = 1; seed <= 5; ++seed) {
    int head = 0, feet = 0, floor = 0, middle = 0;
    for (const auto& pose : make_scan_path(scan, 1.85, seed)) {
      const auto sees = [&](const Vector3d& point) {
        const Vector3d in_camera = pose.inverse() * point;
        return in_camera.z() > 0.5 && scan.calibration.ir.contains(scan.calibration.ir.project(in_camera));
      };
      head += sees({0, 1.85, 0});
      feet += sees({0, 0.02, 0});
      floor += sees({0.4, 0, 0.3});
      middle += sees({0, 1, 0});
    }
    EXPECT_GT(head, 100);
    EXPECT_GT(feet, 70);
    EXPECT_GT(floor, 60);
    EXPECT_EQ(middle, 120);
  }
}

TEST(ScanPath, SeedsDifferAndRepeat) {
  const auto a = make_scan_path(scan_spec(), 1.85, 1), b = make_scan_path(scan_spec(), 1.85, 1),
             c = make_scan_path(scan_spec(), 1.85, 2);
  EXPECT_EQ(a[60].matrix(), b[60].matrix());
  EXPECT_NE(a[60].matrix(), c[60].matrix());
}

TEST(RigPrior, IsOffButWithinTwiceSigma) {
  std::vector<SensorSpec> rig(4);
  for (int i = 0; i < 4; ++i) {
    rig[i].name = "k" + std::to_string(i + 1);
    rig[i].world_from_sensor.translation() = Vector3d(i, 1, 2);
  }
  PriorSpec prior;
  double most_deg = 0, most_m = 0, squares = 0;
  for (Seed seed = 1; seed <= 200; ++seed) {
    const auto rough = perturbed_rig(rig, prior, seed);
    ASSERT_EQ(rough.size(), 4u);
    for (const auto& sensor : rig) {
      const Isometry3d& pose = rough.at(sensor.name);
      const double turned_deg = degrees_between(pose, sensor.world_from_sensor);
      most_deg = std::max(most_deg, turned_deg);
      most_m = std::max(most_m, (pose.translation() - sensor.world_from_sensor.translation()).norm());
      squares += turned_deg * turned_deg;
      EXPECT_NEAR((pose.linear().transpose() * pose.linear() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
    }
  }
  EXPECT_LE(most_deg, 10 + 1e-9);
  EXPECT_LE(most_m, 0.16 + 1e-9);
  EXPECT_GT(most_deg, 9);
  EXPECT_NEAR(std::sqrt(squares / 800), 5, 0.7);
}

}  // namespace
}  // namespace dressform
