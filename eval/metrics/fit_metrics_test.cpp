#include "eval/metrics/fit_metrics.h"

#include <gtest/gtest.h>

#include "eval/metrics/intersections.h"
#include "eval/metrics/mesh_distance.h"
#include "eval/testing/test_meshes.h"

namespace dressform::metrics {
namespace {

using namespace test_meshes;

TEST(Intersections, CountsPairs) {
  const Mesh ball = sphere(0.5, {0, 0, 0}, 12);
  EXPECT_EQ(intersecting_pairs(ball, moved(ball, {2, 0, 0})), 0);
  EXPECT_EQ(intersecting_pairs(sphere(0.3, {0, 0, 0}, 12), ball), 0) << "wholly inside: no triangles meet";
  EXPECT_GT(intersecting_pairs(ball, moved(ball, {0.3, 0, 0})), 10);
  EXPECT_EQ(intersecting_pairs(square(1, 0, 1), square(1, 1e-12, 1)), 0);
  EXPECT_EQ(intersecting_pairs(square(1, 0, 1), square(1, 0, 1)), 4) << "touching counts";
  Mesh flat;
  flat.vertices = {{0.5, 0.4, -1}, {0.5, 0.4, 0}, {0.5, 0.4, 1}};
  flat.triangles = {{0, 1, 2}};
  EXPECT_EQ(intersecting_pairs(flat, square(1, 0, 1)), 1) << "a triangle without area still cuts";
}

TEST(Intersections, OfAMeshWithItself) {
  const Mesh ball = sphere(1, {0, 0, 0}, 20);
  EXPECT_EQ(self_intersecting_pairs(ball), 0) << "neighbours touch, and do not cross";
  const Mesh other = moved(ball, {0.3, 0.1, 0});
  EXPECT_EQ(self_intersecting_pairs(joined(ball, other)), intersecting_pairs(ball, other));
  // A fan round one vertex of which the last triangle is folded through the first.
  Mesh fan;
  fan.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.9, 0.3, 0.5}, {0.6, 0.2, -0.5}};
  fan.triangles = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(self_intersecting_pairs(fan), 0);
  fan.triangles.emplace_back(0, 4, 5);
  EXPECT_EQ(self_intersecting_pairs(fan), 1);
  EXPECT_EQ(self_intersecting_pairs(Mesh{}), 0);
}

TEST(Penetration, DepthOfAShiftedSquareInABall) {
  const Mesh ball = sphere(0.5, {0, 0, 0}, 80);
  const auto outside = penetration(moved(square(0.2, 0, 4), {-0.1, -0.1, 0.6}), ball);
  EXPECT_EQ(outside.max_mm, 0);
  EXPECT_EQ(outside.components_inside, 0);
  const auto within = penetration(moved(square(0.02, 0, 4), {-0.01, -0.01, 0.45}), ball, 0.001);
  EXPECT_NEAR(within.mean_mm, 50, 0.7);
  EXPECT_NEAR(within.area_cm2, 4, 1e-9);
  EXPECT_EQ(within.components_inside, 1);
  // Half of a square inside a cube-like tube: the area that is more than 1 mm deep.
  const auto half =
      penetration(moved(square(0.2, 0, 8), {0, -0.1, 0}), tube(0.1, 0.1, {0, 0, 0}, -1, 1, 256, 4, true), 0.001);
  EXPECT_NEAR(half.area_cm2, 200 * 0.99, 3);
  EXPECT_NEAR(half.max_mm, 100, 1);
}

TEST(Penetration, SignAgreesWithTheWindingNumber) {
  const Mesh probe = moved(square(1, 0.013, 30), {-0.5, 0.7003, 0});
  const Mesh torso = tube(0.18, 0.12, {0, 0, 0}, 0.85, 1.4, 9, 3, true);  // sharp edges: sides and corners are nearest
  for (const auto& vertex : probe.vertices) {
    const Mesh dot{{vertex, vertex + Vector3d(1e-5, 0, 0), vertex + Vector3d(0, 1e-5, 0)}, {{0, 1, 2}}};
    EXPECT_EQ(penetration(dot, torso).max_mm > 0, winding_number(torso, vertex) > 0.5) << vertex.transpose();
  }
}

TEST(EdgeStretch, ScaledMesh) {
  const Mesh before = square(1, 0, 5);
  Mesh after = before;
  for (auto& vertex : after.vertices) vertex *= 1.1;
  EXPECT_NEAR(edge_stretch_p95(before, after), 0.1, 1e-12);
  EXPECT_NEAR(edge_stretch_p95(before, before), 0, 1e-12);
  EXPECT_THROW(edge_stretch_p95(before, square(1, 0, 6)), std::invalid_argument);
}

}  // namespace
}  // namespace dressform::metrics
