#include "synthetic/garments/drape/fall.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/error.h"
#include "synthetic/geometry/self_intersection.h"

namespace dressform {
namespace {

// A strip that hangs from a height of 1.5 m, in right-angled triangles; held at its upper end.
Cloth hanging(double length, int rows) {
  constexpr int kColumns = 4;
  const double edge = length / rows;
  Mesh mesh;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= kColumns; ++i) mesh.vertices.emplace_back(edge * i, 1.5 - edge * j, 0);
  const auto at = [](int i, int j) { return j * (kColumns + 1) + i; };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < kColumns; ++i) {
      mesh.triangles.emplace_back(at(i, j), at(i, j + 1), at(i + 1, j));
      mesh.triangles.emplace_back(at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
    }
  return cloth_as_cut(
      mesh, [](const Vector3d&) { return Eigen::Matrix3d::Identity(); },
      [](const Vector3d& p) { return p.y() > 1.5 - 1e-9; });
}

Wearer nobody(const Cloth& cloth) {
  Wearer wearer;
  wearer.clearance_m.assign(cloth.mesh.vertices.size(), 0.004);
  return wearer;
}

// A metre of cloth in small triangles hangs longer by far than its weight stretches it, as one sweep a step carries too
// little of that to its end; in shorter steps it does not.
TEST(Fall, LongClothGoesOnInShorterSteps) {
  const Cloth cut = hanging(1.0, 100);
  const DrapeParams usual;
  EXPECT_GT(drape(cut, nobody(cut), usual, 1).strain_p95, 0.05);
  Cloth cloth = cut;
  DrapeParams params;
  const ClothRest rest = let_fall_first(cloth, nobody(cut), params, 1);
  EXPECT_LT(rest.strain_p95, 0.045);
  EXPECT_EQ(rest.strain_p95, strain_quantile(cut, cloth.mesh.vertices, 0.95));
  EXPECT_EQ(params.step_s, usual.step_s / 2);
}

TEST(Fall, ShortClothFallsOnce) {
  const Cloth cut = hanging(0.2, 20);
  Cloth cloth = cut;
  DrapeParams params;
  const ClothRest rest = let_fall_first(cloth, nobody(cut), params, 1);
  EXPECT_TRUE(rest.settled);
  EXPECT_EQ(params.step_s, DrapeParams().step_s);
  EXPECT_EQ(cloth.mesh.vertices, drape(cut, nobody(cut), params, 1).vertices);
}

}  // namespace
}  // namespace dressform
