#include "eval/metrics/girths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "synthetic/body/body.h"
#include "synthetic/geometry/contour.h"

namespace dressform::metrics {
namespace {

using Eigen::Vector2d;

struct Build {
  const char* name;
  const char* sex;
  double stature, chest, waist, hip, arm_deg;
};
void PrintTo(const Build& build, std::ostream* out) { *out << build.name; }

// The mannequin and the customer of the library, and builds from slim to stout; the last has more belly than hip.
const Build kBuilds[] = {
    {"mannequin", "male", 1.85, 1.01, 0.81, 0.91, 16}, {"customer", "male", 1.73, 1.13, 1.02, 1.07, 20},
    {"short_man", "male", 1.60, 0.92, 0.76, 0.90, 16}, {"tall_stout_man", "male", 1.95, 1.20, 1.12, 1.18, 16},
    {"slim_man", "male", 1.88, 0.95, 0.80, 0.95, 12},  {"slim_woman", "female", 1.55, 0.82, 0.68, 0.90, 16},
    {"woman", "female", 1.63, 0.95, 0.86, 1.02, 20},   {"stout_woman", "female", 1.68, 1.12, 1.05, 1.18, 16},
    {"belly", "male", 1.72, 1.18, 1.20, 1.12, 18}};

class Builds : public testing::TestWithParam<Build> {};

// The girths that a body was asked for are where its landmarks are, to a few centimetres of height. On the slope of the
// chest just below the armpit that is up to 2 mm of girth a millimetre. The bodies' waist is the survey's, at the
// height of the navel; the tape lies where the trunk is least, which may be higher and is never wider.
TEST_P(Builds, LevelsAreThoseOfTheBody) {
  const Build& build = GetParam();
  BodySpec spec;
  spec.sex = build.sex;
  spec.stature_m = build.stature;
  spec.chest_m = build.chest;
  spec.waist_m = build.waist;
  spec.hip_m = build.hip;
  spec.arm_angle_deg = build.arm_deg;
  const Body body = make_body(spec);
  const auto levels = tape_levels(body.mesh);
  ASSERT_TRUE(levels);
  for (const auto* level : {&levels->chest, &levels->waist, &levels->hip})
    EXPECT_NEAR(level->girth_m, tape_girth(body.mesh, level->y), 5e-4) << level->y;
  EXPECT_NEAR(levels->crotch_y, body.landmarks.crotch, 0.025);
  EXPECT_NEAR(levels->armpit_y, body.landmarks.armpit, 0.045);
  EXPECT_NEAR(levels->hip.y, body.landmarks.hip, 0.03);
  const double trunk = body.landmarks.armpit - body.landmarks.crotch;
  EXPECT_NEAR(levels->waist.y, body.landmarks.crotch + trunk / 2, 0.22 * trunk);
  EXPECT_NEAR(levels->chest.y, body.landmarks.chest, 0.04);
  EXPECT_NEAR(levels->hip.girth_m, spec.hip_m, 0.006);
  if (spec.waist_m < 0.93 * std::min(spec.chest_m, spec.hip_m)) {  // a body with a waist
    double least = spec.waist_m;
    for (double y = levels->hip.y; y < levels->chest.y; y += 0.01) least = std::min(least, tape_girth(body.mesh, y));
    EXPECT_NEAR(levels->waist.girth_m, least, 0.012);
  }
  EXPECT_NEAR(levels->chest.girth_m, spec.chest_m, 0.022);
}
INSTANTIATE_TEST_SUITE_P(All, Builds, testing::ValuesIn(kBuilds), [](const auto& info) { return info.param.name; });

double capsule(const Vector3d& p, const Vector3d& a, const Vector3d& b, double radius) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm() - radius;
}
double box(const Vector3d& p, const Vector3d& centre, const Vector3d& half) {
  return ((p - centre).cwiseAbs() - half).maxCoeff();
}

// A figure of capsules, turned about the vertical; its thighs 10 mm apart up to y = 0.83. `webs` join thighs and fill
// the armpits as a scan's surface does.
Mesh capsule_figure(bool webs, double turn_deg) {
  const Eigen::AngleAxisd turn(turn_deg * M_PI / 180, Vector3d::UnitY());
  const auto field = [&](const Vector3d& world) {
    const Vector3d p = turn.inverse() * world;
    const Vector3d q(std::abs(p.x()), p.y(), p.z());
    double d = capsule(q, {0, 0.97, 0}, {0, 1.33, 0}, 0.15);
    d = std::min(d, capsule(q, {0, 0.93, 0}, {0, 0.97, 0}, 0.165));
    d = std::min(d, capsule(q, {0, 1.3, 0}, {0, 1.70, 0}, 0.07));
    d = std::min(d, capsule(q, {0.085, 0.08, 0}, {0.085, 0.85, 0}, 0.08));
    d = std::min(d, capsule(q, {0, 1.42, 0}, {0.19, 1.42, 0}, 0.05));
    d = std::min(d, capsule(q, {0.21, 1.41, 0}, {0.36, 0.85, 0}, 0.04));
    if (webs) d = std::min(d, box(q, {0, 0.74, 0}, {0.02, 0.09, 0.008}));
    if (webs) d = std::min(d, box(q, {0.17, 1.28, 0}, {0.09, 0.05, 0.006}));
    return d;
  };
  return contour(field, Eigen::AlignedBox3d(Vector3d(-0.55, -0.05, -0.55), Vector3d(0.55, 1.85, 0.55)), 0.008);
}

TEST(TapeLevels, WebsAndHeadingDoNotMoveThem) {
  const auto clean = tape_levels(capsule_figure(false, 0));
  ASSERT_TRUE(clean);
  EXPECT_NEAR(clean->hip.girth_m, 2 * M_PI * 0.165, 0.015);
  EXPECT_NEAR(clean->chest.girth_m, 2 * M_PI * 0.15, 0.004);
  for (const double turn_deg : {0.0, 35.0, 160.0}) {
    const auto webbed = tape_levels(capsule_figure(true, turn_deg));
    ASSERT_TRUE(webbed) << turn_deg;
    EXPECT_NEAR(webbed->crotch_y, clean->crotch_y, 0.012) << turn_deg;
    EXPECT_NEAR(webbed->armpit_y, clean->armpit_y, 0.012) << turn_deg;
    EXPECT_NEAR(webbed->hip.girth_m, clean->hip.girth_m, 0.006) << turn_deg;
    EXPECT_NEAR(webbed->waist.girth_m, clean->waist.girth_m, 0.003) << turn_deg;
    EXPECT_NEAR(webbed->chest.girth_m, clean->chest.girth_m, 0.007) << turn_deg;
  }
}

TEST(TrunkSection, ArmsAreCutOffWhereTheSectionIsThinnest) {
  BodyAxes axes;
  axes.stature = 1.8;
  const std::vector<Vector2d> trunk{{-.16, -.11}, {.16, -.11}, {.16, .11}, {-.16, .11}};
  const std::vector<Vector2d> arm{{.19, -.05}, {.29, -.05}, {.29, .05}, {.19, .05}};
  const TrunkSection apart = trunk_section({{arm, true}, {trunk, true}}, axes);
  EXPECT_EQ(apart.bridge, 0);
  ASSERT_EQ(apart.limbs.size(), 1u);
  EXPECT_NEAR(apart.half_breadth, 0.16, 1e-12);
  EXPECT_NEAR(hull_girth_m(apart.outline), 1.08, 1e-12);
  // The same two joined by a bar 11 mm thick.
  const std::vector<Vector2d> joined{{-.16, -.11}, {.16, -.11}, {.16, -.0055}, {.19, -.0055}, {.19, -.05}, {.29, -.05},
                                     {.29, .05},   {.19, .05},  {.19, .0055},  {.16, .0055},  {.16, .11},  {-.16, .11}};
  const TrunkSection cut = trunk_section({{joined, true}}, axes);
  EXPECT_NEAR(cut.bridge, 0.05, 1e-9);
  ASSERT_EQ(cut.limbs.size(), 1u);
  EXPECT_NEAR(std::abs(signed_area(cut.limbs[0])), 0.01, 4e-4);
  EXPECT_NEAR(cut.half_breadth, 0.16, 0.004);
  EXPECT_NEAR(hull_girth_m(cut.outline), 1.08, 0.004);
}

TEST(BodyAxes, AreWhereTheLegsAre) {
  const auto axes = body_axes(capsule_figure(false, 90));
  ASSERT_TRUE(axes);
  EXPECT_NEAR(std::abs(axes->side.y()), 1, 0.01);
  EXPECT_LT(axes->middle.norm(), 0.005);
  EXPECT_NEAR(axes->stature, 1.77, 0.01);
  Mesh nothing;
  EXPECT_FALSE(body_axes(nothing));
}

}  // namespace
}  // namespace dressform::metrics
