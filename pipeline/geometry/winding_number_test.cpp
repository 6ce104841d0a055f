#include "pipeline/geometry/winding_number.h"

#include <gtest/gtest.h>

#include "pipeline/geometry/lattice.h"

namespace dressform {
namespace {

Mesh ball_of(double radius_m) {
  const Lattice lattice = make_lattice(Vector3d::Constant(-radius_m), Vector3d::Constant(radius_m), 0.05, 0.02);
  std::vector<float> field(lattice.count());
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = static_cast<float>(lattice.point(i).norm() - radius_m);
  return lattice_surface(lattice, field);
}

TEST(WindingNumber, OneInsideABallAndNoneOutside) {
  const WindingNumber winding(ball_of(0.2));
  for (const double r : {0.0, 0.1, 0.18}) EXPECT_NEAR(winding({0.3 * r, 0.6 * r, -0.7 * r}), 1, 0.02) << r;
  for (const double r : {0.22, 0.3, 2.0}) EXPECT_NEAR(winding(Vector3d(0.3, 0.6, -0.75).normalized() * r), 0, 0.02);
}

TEST(WindingNumber, HalfInTheMiddleOfAHalfBall) {
  Mesh half = ball_of(0.2);
  std::vector<Vector3i> kept;
  for (const Vector3i& t : half.triangles)
    if (half.vertices[t[0]].y() + half.vertices[t[1]].y() + half.vertices[t[2]].y() > 0) kept.push_back(t);
  half.triangles = kept;
  const WindingNumber winding(half);
  EXPECT_NEAR(winding(Vector3d::Zero()), 0.5, 0.05);
  EXPECT_GT(winding({0, 0.1, 0}), 0.7);
  EXPECT_LT(winding({0, -0.1, 0}), 0.3);
}

TEST(WindingNumber, NothingGoesRoundNothing) {
  EXPECT_EQ(WindingNumber({})({1, 2, 3}), 0);
  Mesh speck{{Vector3d::Zero()}, {{0, 0, 0}}};
  EXPECT_TRUE(std::isfinite(WindingNumber(speck)(Vector3d::Zero())));
}

}  // namespace
}  // namespace dressform
