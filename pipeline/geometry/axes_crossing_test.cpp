#include "pipeline/geometry/axes_crossing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/small_solvers.h"

namespace dressform {
namespace {

// A sensor at `eye` whose optical axis goes through `target`.
Isometry3d looking(const Vector3d& eye, const Vector3d& target) {
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = rotation_between(Vector3d::UnitZ(), target - eye);
  pose.translation() = eye;
  return pose;
}

using Poses = std::vector<Isometry3d>;

TEST(AxesCrossing, IsWhereAllSensorsLook) {
  const Vector3d place(0.1, 1, -0.2);
  for (const int count : {2, 3, 7}) {
    std::vector<Isometry3d> rig;
    for (int k = 0; k < count; ++k)
      rig.push_back(looking(Vector3d(2 * std::cos(1.3 * k), 1.2, 2 * std::sin(1.3 * k)), place));
    const auto found = axes_crossing(rig);
    ASSERT_TRUE(found);
    EXPECT_LT((*found - place).norm(), 1e-9) << count;
  }
}

TEST(AxesCrossing, OfAxesThatPassIsHalfWay) {
  const auto found = axes_crossing(Poses{looking({0, 0, -2}, {0, 0, 0}), looking({-2, 0.2, 0}, {0, 0.2, 0})});
  ASSERT_TRUE(found);
  EXPECT_LT((*found - Vector3d(0, 0.1, 0)).norm(), 1e-9);
}

TEST(AxesCrossing, OneAxisAndParallelOnesCrossNowhere) {
  EXPECT_FALSE(axes_crossing(Poses{}));
  EXPECT_FALSE(axes_crossing(Poses{looking({0, 0, -2}, {0, 0, 0})}));
  EXPECT_FALSE(axes_crossing(Poses{looking({0, 0, -2}, {0, 0, 0}), looking({1, 0, -2}, {1, 0, 0})}));
}

}  // namespace
}  // namespace dressform
