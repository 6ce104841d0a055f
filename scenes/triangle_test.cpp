#include "scenes/triangle.h"

#include <gtest/gtest.h>

namespace dressform {
namespace {

TEST(ClosestBarycentric, InsideOnAnEdgeAndAtACorner) {
  const Vector3d a(0, 0, 0), b(2, 0, 0), c(0, 2, 0);
  EXPECT_LT((closest_barycentric({0.5, 0.5, 3}, a, b, c) - Vector3d(0.5, 0.25, 0.25)).norm(), 1e-12);
  EXPECT_LT((closest_barycentric({1, -4, 1}, a, b, c) - Vector3d(0.5, 0.5, 0)).norm(), 1e-12);
  EXPECT_LT((closest_barycentric({3, 3, 0}, a, b, c) - Vector3d(0, 0.5, 0.5)).norm(), 1e-12);
  EXPECT_EQ(closest_barycentric({-1, -1, 0}, a, b, c), Vector3d(1, 0, 0));
}

TEST(ClosestBarycentric, OfATriangleThatIsAPointOrALine) {
  const Vector3d a(1, 2, 3), b(2, 2, 3);
  EXPECT_EQ(closest_barycentric({0, 0, 0}, a, a, a).sum(), 1);
  const Vector3d w = closest_barycentric({1.25, 5, 3}, a, b, a);
  EXPECT_LT((w[0] * a + w[1] * b + w[2] * a - Vector3d(1.25, 2, 3)).norm(), 1e-12);
}

TEST(TriangleArea, HalfOfASquareAndNothingOfALine) {
  const Mesh mesh{{{1, 1, 1}, {3, 1, 1}, {1, 1, 3}, {5, 1, 1}}, {{0, 1, 2}, {0, 1, 3}}};
  EXPECT_EQ(triangle_area_m2(mesh, mesh.triangles[0]), 2);
  EXPECT_EQ(triangle_areas_m2(mesh), (std::vector<double>{2, 0}));
}

}  // namespace
}  // namespace dressform
