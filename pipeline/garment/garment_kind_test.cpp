#include "pipeline/garment/garment_kind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

Landmarks standing() {
  Landmarks limbs;
  limbs.top_y = limbs.stature = 1.8;
  limbs.crotch_y = 0.85;
  for (const double side : {1.0, -1.0}) {
    Limb leg;
    leg.root = {0.1 * side, 0.85, 0};
    leg.direction = {0, -1, 0};
    leg.length = 0.85;
    leg.fork_y = 0.85;
    (side > 0 ? limbs.left_leg : limbs.right_leg) = leg;
  }
  return limbs;
}

// A tube about (x, z) from y = 0.35 to 0.95 whose radii wave by `fold` as often as `waves` says.
void add_tube(double x, double across, double depth, double fold, int waves, double phase,
              std::vector<Vector3d>& points) {
  for (double y = 0.35; y < 0.95; y += 0.01)
    for (double angle = 0; angle < 2 * M_PI; angle += 0.02) {
      const double wave = fold * (0.95 - y) / 0.6 * std::cos(waves * angle + phase);
      points.emplace_back(x + (across + wave) * std::sin(angle), y, (depth + wave) * std::cos(angle));
    }
}

// Whichever fold lies in the middle, a ridge or a valley in front, at the back or on both sides.
TEST(BottomKind, FoldsOfASkirtAreNoLegs) {
  for (const int waves : {3, 4, 5, 6, 7, 8, 9})
    for (const double phase : {0.0, 0.5 * M_PI, M_PI, 1.5 * M_PI}) {
      std::vector<Vector3d> points;
      add_tube(0, 0.24, 0.20, 0.03, waves, phase, points);
      EXPECT_EQ(bottom_kind(points, standing()).kind, "skirt") << waves << " folds, phase " << phase;
    }
}

TEST(BottomKind, LegsOfTrousersAreLegsCloseOrWide) {
  for (const double radius : {0.06, 0.08, 0.097}) {
    std::vector<Vector3d> points;
    for (const double x : {-0.1, 0.1}) add_tube(x, radius, radius, 0.006, 4, 1, points);
    EXPECT_EQ(bottom_kind(points, standing()).kind, "trousers") << radius;
  }
}

// Half of either garment is enough, as a single view shows it.
TEST(BottomKind, OneSideTells) {
  for (const double sign : {1.0, -1.0}) {
    std::vector<Vector3d> skirt, legs, half_skirt, half_legs;
    add_tube(0, 0.24, 0.20, 0.02, 5, 0.3, skirt);
    for (const double x : {-0.1, 0.1}) add_tube(x, 0.08, 0.08, 0, 0, 0, legs);
    for (const Vector3d& p : skirt)
      if (sign * p.z() > 0) half_skirt.push_back(p);
    for (const Vector3d& p : legs)
      if (sign * p.z() > 0) half_legs.push_back(p);
    EXPECT_EQ(bottom_kind(half_skirt, standing()).kind, "skirt");
    EXPECT_EQ(bottom_kind(half_legs, standing()).kind, "trousers");
  }
}

TEST(WithKind, TrousersCoverTheLegsThatAreThere) {
  GarmentLayout layout;
  layout.top_y = 1;
  Landmarks one_leg = standing();
  one_leg.right_leg.reset();
  const GarmentLayout trousers = with_kind(layout, {"trousers", 0.7}, one_leg);
  EXPECT_TRUE(trousers.legs[0].covered);
  EXPECT_FALSE(trousers.legs[1].covered);
  EXPECT_EQ(trousers.sure_kind, 0.7);
  EXPECT_EQ(trousers.top_y, 1);
  EXPECT_FALSE(with_kind(trousers, {"skirt", 1}, standing()).legs[0].covered);
}

TEST(TopKind, ADressHangsBelowTheCrotch) {
  std::vector<Vector3d> points;
  add_tube(0, 0.24, 0.20, 0.02, 5, 0.3, points);  // down to y = 0.35
  EXPECT_EQ(top_kind(points, standing()).kind, "dress");
  points.erase(std::remove_if(points.begin(), points.end(), [](const Vector3d& p) { return p.y() < 0.8; }),
               points.end());
  EXPECT_EQ(top_kind(points, standing()).kind, "shirt");
  EXPECT_EQ(top_kind({}, standing()).kind, "shirt");
}

}  // namespace
}  // namespace dressform
