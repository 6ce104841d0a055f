#include "pipeline/geometry/mesh_query.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/random.h"

namespace dressform {
namespace {

Mesh cube(double half) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

double cube_distance(const Vector3d& p, double half) {
  const Vector3d q = p.cwiseAbs() - Vector3d::Constant(half);
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
}

TEST(MeshQuery, SignedDistanceOfCube) {
  const MeshQuery query(cube(0.5));
  for (int i = 0; i < 2000; ++i) {
    const auto u = uniform4(1, 2, i);
    const Vector3d p(2 * u[0] - 1, 2 * u[1] - 1, 2 * u[2] - 1);
    EXPECT_NEAR(query.signed_distance(p), cube_distance(p, 0.5), 1e-9);
  }
}

TEST(MeshQuery, SignAtCornersAndEdges) {
  const MeshQuery query(cube(0.5));
  EXPECT_GT(query.signed_distance({0.6, 0.6, 0.6}), 0);
  EXPECT_GT(query.signed_distance({0.6, 0.6, 0.0}), 0);
  EXPECT_LT(query.signed_distance({0.49, 0.49, 0.49}), 0);
}

TEST(MeshQuery, MaximumDistanceIsKept) {
  const MeshQuery query(cube(0.5));
  EXPECT_EQ(query.closest({2, 0, 0}, 1.0).triangle, -1);
  EXPECT_NEAR(query.closest({1.4, 0, 0}, 1.0).distance, 0.9, 1e-9);
}

TEST(MeshQuery, FirstHit) {
  const MeshQuery query(cube(0.5));
  const auto hit = query.first_hit({-2, 0.1, 0.2}, {2, 0, 0});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 0.75, 1e-6);
  EXPECT_NEAR(hit->point.x(), -0.5, 1e-6);
  EXPECT_NEAR(query.normal(hit->triangle).x(), -1, 1e-12);
  EXPECT_FALSE(query.first_hit({-2, 0.6, 0.2}, {1, 0, 0}));
}

TEST(MeshQuery, EmptyMeshHasNothing) {
  const MeshQuery query{Mesh{}};
  EXPECT_EQ(query.closest({0, 0, 0}).triangle, -1);
  EXPECT_FALSE(query.first_hit({0, 0, 0}, {1, 0, 0}));
  EXPECT_TRUE(std::isinf(query.signed_distance({0, 0, 0})));
}

}  // namespace
}  // namespace dressform
