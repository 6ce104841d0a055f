#include "pipeline/fuse/thigh_gap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/body/body_limbs.h"

namespace dressform {
namespace {

double capsule(const Vector3d& p, const Vector3d& a, const Vector3d& b, double radius) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm() - radius;
}

// Legs that come closer going up, 1.76 m tall; `top_x`: of a thigh's axis below the crotch, which is 0.09 thick.
double figure(const Vector3d& p, double top_x) {
  double d = capsule(p, {0, 1.0, 0}, {0, 1.6, 0}, 0.16);
  for (const double side : {-1.0, 1.0})
    d = std::min(d, capsule(p, {side * 0.14, 0.09, 0}, {side * top_x, 0.86, 0}, 0.09));
  return d;
}

struct Solid {
  Lattice lattice = make_lattice({-0.25, 0, -0.2}, {0.25, 1.77, 0.2}, 0.03, 0.009);
  std::vector<float> field;
  Mesh surface;

  explicit Solid(double top_x) {
    for (std::size_t i = 0; i < lattice.count(); ++i)
      field.push_back(static_cast<float>(figure(lattice.point(i), top_x)));
    surface = lattice_surface(lattice, field);
  }
};

TEST(ThighGap, ThighsThatTouchComeApart) {
  for (const double top_x : {0.080, 0.092}) {  // webbed from two thirds up; 3 mm apart at the narrowest
    Solid solid(top_x);
    const std::vector<float> before = solid.field;
    ASSERT_TRUE(part_thighs(solid.lattice, solid.surface, 0.012, solid.field));
    for (std::size_t i = 0; i < before.size(); ++i) {
      const Vector3d p = solid.lattice.point(i);
      EXPECT_GE(solid.field[i], before[i]);
      if (std::abs(p.x()) < 0.001 && p.y() > 0.55 && p.y() < 0.80) {
        EXPECT_GT(solid.field[i], 0.004f) << p.transpose();
      }
      if (std::abs(p.x()) > 0.010 + solid.lattice.step_m || p.y() < 0.40 || p.y() > 0.95) {
        EXPECT_EQ(solid.field[i], before[i]) << p.transpose();
      }
    }
    const BodyLimbs limbs = find_limbs(lattice_surface(solid.lattice, solid.field));
    ASSERT_TRUE(limbs.left_leg && limbs.right_leg);
    EXPECT_GT(limbs.crotch_y, 0.82);
  }
}

TEST(ThighGap, ThighsApartAndWhatHasNoLegsAreLeftAlone) {
  Solid apart(0.105);
  const std::vector<float> before = apart.field;
  EXPECT_FALSE(part_thighs(apart.lattice, apart.surface, 0.012, apart.field));
  EXPECT_EQ(apart.field, before);
  Solid pillar(0.0);
  std::vector<float> ball(pillar.lattice.count());
  for (std::size_t i = 0; i < ball.size(); ++i)
    ball[i] = static_cast<float>((pillar.lattice.point(i) - Vector3d(0, 0.9, 0)).norm() - 0.15);
  const std::vector<float> same = ball;
  EXPECT_FALSE(part_thighs(pillar.lattice, lattice_surface(pillar.lattice, ball), 0.012, ball));
  EXPECT_EQ(ball, same);
}

}  // namespace
}  // namespace dressform
