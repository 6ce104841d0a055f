#include <gtest/gtest.h>

#include <cmath>

#include "eval/metrics/girths.h"
#include "eval/testing/test_meshes.h"

namespace dressform::metrics {
namespace {

using namespace test_meshes;

double ellipse_girth(double a, double b) {  // Ramanujan
  const double h = std::pow((a - b) / (a + b), 2);
  return M_PI * (a + b) * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h)));
}

TEST(Girths, Hull) {
  EXPECT_NEAR(hull_girth_m({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.5}, {0.5, 0}}), 4, 1e-12);
  EXPECT_EQ(hull_girth_m({}), 0);
}

TEST(Girths, LevelsOfAFigure) {
  const auto levels = tape_levels(figure());
  ASSERT_TRUE(levels);
  EXPECT_NEAR(levels->crotch_y, 0.85, 0.015);
  EXPECT_NEAR(levels->armpit_y, 1.4, 0.025);
  EXPECT_NEAR(levels->waist.y, 1.1, 0.02);
  EXPECT_NEAR(levels->waist.girth_m, ellipse_girth(0.18 * 0.85, 0.12 * 0.85), 0.003);
  EXPECT_NEAR(levels->chest.girth_m, ellipse_girth(0.18, 0.12), 0.003) << "arms are left out";
  EXPECT_NEAR(levels->hip.girth_m, ellipse_girth(0.18, 0.12), 0.004);
  EXPECT_FALSE(tape_levels(sphere(1, {0, 1, 0}, 30)));
  EXPECT_FALSE(tape_levels(Mesh{}));
}

TEST(Girths, GarmentRoundTheTorso) {
  const auto levels = tape_levels(figure());
  ASSERT_TRUE(levels);
  const Mesh shirt = joined(tube(0.2, 0.14, {0, 0, 0}, 0.9, 1.45, 128, 30, false),
                            tube(0.05, 0.05, {0.26, 0, 0}, 1.0, 1.4, 32, 10, false));
  const auto girth = garment_girth_m(shirt, levels->chest);
  ASSERT_TRUE(girth);
  EXPECT_NEAR(*girth, ellipse_girth(0.2, 0.14), 0.002) << "the sleeve is left out";
  EXPECT_FALSE(garment_girth_m(tube(0.2, 0.14, {0, 0, 0}, 0.1, 0.5, 64, 10, false), levels->chest));
  EXPECT_FALSE(garment_girth_m(tube(0.05, 0.05, {0.26, 0, 0}, 1.0, 1.4, 32, 10, false), levels->chest));
}

TEST(Girths, WideSleeveBesideTheTorsoIsLeftOut) {
  const auto levels = tape_levels(figure());
  ASSERT_TRUE(levels);
  // The sleeve's inner side is nearer to the torso (15 mm) than to the arm (25 mm), and is no torso's cloth for that.
  const Mesh torso = tube(0.19, 0.14, {0, 0, 0}, 0.9, 1.45, 128, 30, false);
  const Mesh sleeve = tube(0.065, 0.065, {0.26, 0, 0}, 1.0, 1.4, 64, 10, false);
  const auto girth = garment_girth_m(joined(torso, sleeve), levels->chest);
  ASSERT_TRUE(girth);
  EXPECT_NEAR(*girth, *garment_girth_m(torso, levels->chest), 1e-12);
  // Its slanted cuff at that height: an open line.
  Mesh cuff = sleeve;
  cuff.triangles.clear();
  for (const auto& t : sleeve.triangles)
    if (sleeve.vertices[t[0]].x() < 0.27 || sleeve.vertices[t[0]].y() > levels->chest.y + 0.05)
      cuff.triangles.push_back(t);
  EXPECT_NEAR(*garment_girth_m(joined(torso, cuff), levels->chest), *girth, 1e-12);
}

TEST(Girths, SleevesThatJoinTheTorsoAreLeftOut) {
  const auto levels = tape_levels(figure());
  ASSERT_TRUE(levels);
  // One tube round torso and arms: its hull is not the torso's girth.
  const Mesh cape = tube(0.32, 0.14, {0, 0, 0}, 0.9, 1.45, 400, 30, false);
  const auto girth = garment_girth_m(cape, levels->chest);
  ASSERT_TRUE(girth);
  EXPECT_LT(*girth, ellipse_girth(0.28, 0.14));
  EXPECT_GT(*girth, ellipse_girth(0.18, 0.14));
}

TEST(Girths, SectionOfAnOpenMeshIsALine) {
  const auto lines = horizontal_section(tube(0.2, 0.2, {0, 0, 0}, 0, 1, 16, 4, false), 0.3);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_TRUE(lines[0].closed);
  Mesh slit = square(1, 0, 4);
  const auto cut = horizontal_section(slit, 0.3);
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_FALSE(cut[0].closed);
  EXPECT_EQ(cut[0].points.size(), 9u);
}

}  // namespace
}  // namespace dressform::metrics
