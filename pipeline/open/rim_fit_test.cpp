#include "pipeline/open/rim_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "pipeline/open/depth_edges.h"
#include "scenes/random.h"

namespace dressform {
namespace {

TEST(RimFit, SlantedRimWithOutliersAndAGap) {
  std::vector<RimSample> samples;
  const auto truth = [](double angle) { return 0.2 + 0.02 * std::cos(angle) + 0.01 * std::sin(2 * angle); };
  for (int i = 0; i < 600; ++i) {
    const double angle = -M_PI + 2 * M_PI * i / 600.0;
    if (angle > 1.0 && angle < 1.8) continue;  // hidden
    const auto noise = normal4(5, 1, i);
    samples.push_back({angle, truth(angle) + 0.002 * noise[0], 1});
    if (i % 5 == 0) samples.push_back({angle, 0.05 + 0.01 * noise[1], 1});  // edges of something else
    if (angle < -2.9) samples.push_back({angle, 0.06, 1});
  }
  const RimCurve curve = fit_rim(samples, {});
  for (double angle = -3; angle < 3.1; angle += 0.05)
    EXPECT_NEAR(curve.at(angle), truth(angle), angle > 0.9 && angle < 1.9 ? 0.006 : 0.003) << angle;
  EXPECT_NEAR(curve.coverage, 1 - 0.8 / (2 * M_PI), 0.06);
  EXPECT_TRUE(curve.unseen(1.4));
  for (const double seen : {-3.0, -1.0, 0.5, 2.3}) EXPECT_FALSE(curve.unseen(seen)) << seen;
  EXPECT_LT(curve.residual_rms_m, 0.004);
}

TEST(RimFit, WhatIsHiddenGoesOnAsAFlatCut) {
  std::vector<RimSample> samples;
  const auto truth = [](double angle) { return 0.3 + 0.015 * std::cos(angle) - 0.01 * std::sin(angle); };
  for (int i = 0; i < 600; ++i) {
    const double angle = -M_PI + 2 * M_PI * i / 600.0;
    const auto noise = normal4(6, 1, i);
    if (std::abs(angle) < 1.2 || std::abs(angle) > 2.6) samples.push_back({angle, truth(angle) + 0.002 * noise[0], 1});
    // The outline of the limb: many samples at all places along it, next to what is hidden.
    if (angle > 1.2 && angle < 1.5)
      for (int k = 0; k < 20; ++k) samples.push_back({angle, 0.01 * k + 0.05, 1});
  }
  const FlatCut flat = fit_flat_cut(samples, 0.008);
  EXPECT_NEAR(flat.middle, 0.3, 0.002);
  EXPECT_NEAR(flat.tilt_cos, 0.015, 0.002);
  EXPECT_NEAR(flat.tilt_sin, -0.01, 0.003);
  const RimCurve curve = fit_rim(samples, {});
  for (double angle = -3; angle < 3.1; angle += 0.05) EXPECT_NEAR(curve.at(angle), truth(angle), 0.006) << angle;
}

TEST(RimFit, DeepVNeckIsFollowed) {
  std::vector<RimSample> samples;
  const auto truth = [](double angle) { return -0.09 - 0.08 * std::max(0.0, 1 - std::abs(angle) / 0.7); };
  for (int i = 0; i < 500; ++i) {
    const double angle = -M_PI + 2 * M_PI * i / 500.0;
    samples.push_back({angle, truth(angle) + 0.002 * normal4(7, 1, i)[0], 1});
  }
  const RimCurve curve = fit_rim(samples, {});
  for (double angle = -3; angle < 3.1; angle += 0.05)
    EXPECT_NEAR(curve.at(angle), truth(angle), std::abs(angle) < 0.1 ? 0.012 : 0.005) << angle;
}

// Where a print or a shadow draws the mask's edge into the cloth, and nothing shows the true edge.
TEST(RimFit, StraysThatReachALittleWayRoundMakeNoDent) {
  for (const double depth : {0.035, 0.045}) {
    std::vector<RimSample> samples;
    const auto truth = [](double angle) { return -0.1 + 0.02 * std::cos(angle) - 0.008 * std::cos(2 * angle); };
    for (int i = 0; i < 500; ++i) {
      const double angle = -M_PI + 2 * M_PI * i / 500.0, off = std::abs(angle + 1.4);
      const double stray = off < 0.2 ? depth * (1 - off / 0.3) : 0;
      samples.push_back({angle, truth(angle) - stray + 0.001 * normal4(8, 1, i)[0], 0.5});
    }
    const RimCurve curve = fit_rim(samples, {});
    for (double angle = -3; angle < 3.1; angle += 0.05) EXPECT_NEAR(curve.at(angle), truth(angle), 0.010) << angle;
  }
}

TEST(RimFit, DepthOfTheSameViewOverrulesMaskEdges) {
  const std::vector<RimSample> mask{{0.00, 0.30, 1, 0}, {0.02, 0.28, 1, 0}, {0.02, 0.30, 1, 1}, {1.00, 0.30, 1, 0}};
  const std::vector<RimSample> depth{{0.03, 0.275, 1, 0}, {0.05, 0.270, 1, 0}};
  const auto both = reconciled(mask, depth, 0.010);
  ASSERT_EQ(both.size(), 5u);  // the first of the mask's is gone: the third is another view's, the fourth elsewhere
  EXPECT_EQ(both[0].along, 0.28);
  EXPECT_EQ(both[1].view, 1);
  EXPECT_EQ(both[2].angle, 1.00);
}

TEST(RimFit, NothingSeenIsNoCurve) {
  EXPECT_TRUE(fit_rim({}, {}).knots.empty());
  EXPECT_EQ(fit_rim({}, {}).coverage, 0);
}

}  // namespace
}  // namespace dressform
