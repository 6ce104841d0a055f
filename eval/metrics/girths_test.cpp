#include "eval/metrics/girths.h"

#include <gtest/gtest.h>

#include "synthetic/body/body.h"

namespace dressform::metrics {
namespace {

// The mannequin and the customer of the library: their girths are asked for, and the scorer's tape must find them.
TEST(TapeLevels, FindTheGirthsThatABodyWasMadeWith) {
  BodySpec mannequin, customer;
  customer.stature_m = 1.73;
  customer.chest_m = 1.13;
  customer.waist_m = 1.02;
  customer.hip_m = 1.07;
  customer.arm_angle_deg = 20;
  for (const BodySpec& spec : {mannequin, customer}) {
    const Body body = make_body(spec);
    const auto levels = tape_levels(body.mesh);
    ASSERT_TRUE(levels);
    EXPECT_NEAR(levels->chest.girth_m, spec.chest_m, 0.03);
    EXPECT_NEAR(levels->waist.girth_m, spec.waist_m, 0.015);
    EXPECT_NEAR(levels->hip.girth_m, spec.hip_m, 0.015);
    EXPECT_NEAR(levels->crotch_y, body.landmarks.crotch, 0.03);
    EXPECT_NEAR(levels->armpit_y, body.landmarks.armpit, 0.04);
    EXPECT_NEAR(levels->waist.y, body.landmarks.waist, 0.06);
    EXPECT_NEAR(levels->chest.y, body.landmarks.chest, 0.08);
    EXPECT_NEAR(levels->hip.y, body.landmarks.hip, 0.08);
  }
}

}  // namespace
}  // namespace dressform::metrics
