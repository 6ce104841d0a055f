#include "pipeline/alignment/pair_equations.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dressform {
namespace {

TEST(MotionAbout, AQuarterTurnLeavesItsCentreAndMovesTheOrigin) {
  const Vector3d centre(1, 2, 3);
  Vector6d step;
  step << 0, M_PI / 2, 0, 0, 0, 0;
  const Isometry3d motion = motion_about(step, centre);
  EXPECT_LT((motion * centre - centre).norm(), 1e-12);
  EXPECT_LT((motion * Vector3d(0, 2, 0) - Vector3d(-2, 2, 4)).norm(), 1e-12);
}

TEST(MotionAbout, IsWhatMotionAtReads) {
  const Vector3d centre(-0.3, 1.1, 0.2);
  Vector6d step;
  step << 0.2, -0.1, 0.4, 0.01, 0.02, -0.03;
  EXPECT_LT((motion_at(motion_about(step, centre), centre) - step).norm(), 1e-12);
  EXPECT_EQ(motion_about(Vector6d::Zero(), centre).matrix(), Isometry3d::Identity().matrix());
}

TEST(Exponential, TurnsAboutTheOriginAndIsNegligibleWhenSmall) {
  Vector6d twist;
  twist << 0, 0, M_PI / 2, 0.5, 0, 0;
  EXPECT_LT((exponential(twist) * Vector3d(1, 0, 0) - Vector3d(0.5, 1, 0)).norm(), 1e-12);
  EXPECT_FALSE(negligible(twist, 2, 0.4));
  EXPECT_FALSE(negligible(twist, 1.5, 0.6));
  EXPECT_TRUE(negligible(twist, 2, 0.6));
}

}  // namespace
}  // namespace dressform
