#include "eval/wardrobe/layers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "eval/metrics/intersections.h"

namespace dressform {
namespace {

// An open upright tube with its normals outward.
Mesh tube_of(double radius_m, double low_m, double high_m, int around = 60, int rows = 20) {
  Mesh mesh;
  for (int row = 0; row <= rows; ++row)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * M_PI * i / around;
      mesh.vertices.emplace_back(radius_m * std::sin(angle), high_m + row * (low_m - high_m) / rows,
                                 radius_m * std::cos(angle));
    }
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i < around; ++i) {
      const int a = row * around + i, b = row * around + (i + 1) % around;
      mesh.triangles.emplace_back(a, a + around, b + around);
      mesh.triangles.emplace_back(a, b + around, b);
    }
  return mesh;
}

TEST(LiftedOver, AShirtThatLiesUnderTheTrousersComesOverThem) {
  const Mesh trousers = tube_of(0.20, 0.2, 1.0), shirt = tube_of(0.195, 0.8, 1.4, 48);
  const Mesh over = lifted_over(shirt, trousers, {});
  EXPECT_EQ(over.triangles, shirt.triangles);
  EXPECT_EQ(metrics::intersecting_pairs(over, trousers), 0);
  for (std::size_t v = 0; v < over.vertices.size(); ++v) {
    const Vector3d &before = shirt.vertices[v], &after = over.vertices[v];
    if (before.y() < 0.98) {
      EXPECT_GT(std::hypot(after.x(), after.z()), 0.2);
    }
    if (before.y() > 1.2) {
      EXPECT_EQ(before, after);  // above the waist nothing is in the way
    }
  }
}

TEST(LiftedOver, ClearClothAndNoInnerGarmentMoveNothing) {
  const Mesh shirt = tube_of(0.22, 0.8, 1.4);
  EXPECT_EQ(lifted_over(shirt, tube_of(0.20, 0.2, 1.0), {}).vertices, shirt.vertices);
  EXPECT_EQ(lifted_over(shirt, {}, {}).vertices, shirt.vertices);
}

}  // namespace
}  // namespace dressform
