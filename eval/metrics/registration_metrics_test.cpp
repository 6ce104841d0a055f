#include "eval/metrics/registration_metrics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "eval/testing/test_meshes.h"

namespace dressform::metrics {
namespace {

using namespace test_meshes;

Isometry3d turn(double degrees, const Vector3d& axis) {
  return Isometry3d(Eigen::AngleAxisd(degrees * M_PI / 180, axis.normalized()));
}

TEST(RegistrationMetrics, SmallAndLargeAngles) {
  const Isometry3d truth = Eigen::Translation3d(1, 2, 3) * turn(77, {1, 2, 3});
  for (const double degrees : {0.0, 1e-6, 0.01, 0.5, 30.0, 179.0}) {
    const Isometry3d estimate = truth * turn(degrees, {3, -1, 2});
    EXPECT_NEAR(rotation_error_deg(estimate, truth), degrees, 1e-7 + 1e-9 * degrees);
    EXPECT_NEAR(translation_error_mm(estimate, truth), 0, 1e-9) << "turned about its own centre";
  }
  EXPECT_NEAR(translation_error_mm(Eigen::Translation3d(0, 0.003, 0.004) * truth, truth), 5, 1e-9);
}

TEST(RegistrationMetrics, TargetError) {
  const Isometry3d truth = Eigen::Translation3d(0, 0, -2) * Isometry3d::Identity();
  const std::vector<Vector3d> targets{{0, 1, 0}, {0, -1, 0}};
  EXPECT_NEAR(target_registration_error_mm(Eigen::Translation3d(0.003, 0, 0) * truth, truth, targets), 3, 1e-9);
  // Turned by a about the camera's own axis: each target moves by 2 sin(a / 2) m.
  EXPECT_NEAR(target_registration_error_mm(truth * turn(0.5, {0, 0, 1}), truth, targets),
              2000 * std::sin(0.25 * M_PI / 180), 1e-6);
  EXPECT_TRUE(std::isnan(target_registration_error_mm(truth, truth, {})));
}

TEST(RegistrationMetrics, TargetsAreWhatTheSensorSees) {
  const Mesh two = joined(sphere(0.3, {0, 0, 0}, 20), sphere(0.3, {0, 0, 1}, 20));
  const Isometry3d sensor = Eigen::Translation3d(0, 0, -3) * Isometry3d::Identity();
  const auto seen = points_seen(two, sensor, 0.02, 1);
  ASSERT_GT(seen.size(), 500u);
  for (const auto& point : seen) EXPECT_TRUE(point.z() < 0 || point.head<2>().norm() > 0.2);
  int behind = 0;
  for (const auto& point : seen) behind += point.z() > 0.5;
  EXPECT_LT(behind, 100) << "the second ball hides behind the first";
}

}  // namespace
}  // namespace dressform::metrics
