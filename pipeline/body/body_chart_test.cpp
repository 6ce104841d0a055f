#include "pipeline/body/body_chart.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/testing/figure.h"

namespace dressform {
namespace {

TEST(BodyChart, AnglesGoFromTheFrontToTheLeftOnEveryLimbWhateverTheHeading) {
  for (const double yaw : {0.0, 2.0}) {
    const Landmarks landmarks = find_landmarks(make_figure({1.8, 1, 15, yaw}));
    const BodyChart chart(landmarks);
    for (const BodyPart limb : {BodyPart::torso, BodyPart::left_arm, BodyPart::right_arm, BodyPart::left_leg}) {
      const Limb* axis = is_arm(limb) ? landmarks.arm(side_of(limb)) : is_leg(limb) ? landmarks.leg(0) : nullptr;
      const Vector3d on_axis = axis ? Vector3d(axis->root + 0.2 * axis->direction)
                                    : Vector3d(landmarks.axis.x(), landmarks.crotch_y + 0.2, landmarks.axis.z());
      const ChartPlace front = chart.place(on_axis + 0.05 * landmarks.front, limb);
      EXPECT_NEAR(front.along_m, 0.2, 0.01);
      EXPECT_NEAR(front.radius_m, 0.05, 0.002);
      EXPECT_NEAR(front.angle, 0, 0.05);
      EXPECT_NEAR(chart.place(on_axis + 0.05 * landmarks.left, limb).angle, M_PI / 2, 0.05);
      EXPECT_NEAR(chart.place(on_axis - 0.05 * landmarks.left, limb).angle, -M_PI / 2, 0.05);
    }
  }
}

TEST(BodyChart, PartsOfLimbsRunFromRootToEnd) {
  const Landmarks landmarks = find_landmarks(make_figure({}));
  const BodyChart chart(landmarks);
  const Limb& arm = *landmarks.left_arm;
  EXPECT_NEAR(chart.part_of_limb(arm.root + 0.5 * arm.length * arm.direction, BodyPart::left_arm), 0.5, 1e-9);
  EXPECT_EQ(chart.part_of_limb(arm.root - arm.direction, BodyPart::left_arm), 0);
  EXPECT_EQ(chart.part_of_limb(arm.root + 9 * arm.direction, BodyPart::left_arm), 1);
  EXPECT_EQ(chart.part_of_limb(arm.root, BodyPart::torso), 0);
  EXPECT_EQ(BodyChart(Landmarks{}).part_of_limb({0, 1, 0}, BodyPart::left_leg), 0);
}

}  // namespace
}  // namespace dressform
