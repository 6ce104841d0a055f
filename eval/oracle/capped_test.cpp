#include "eval/oracle/capped.h"

#include <gtest/gtest.h>

namespace dressform {
namespace {

// An upright tube of 32 sides, radius 1 m, from y = 0 to 1, open at both ends, outward.
Mesh tube() {
  Mesh mesh;
  const int sides = 32;
  for (const double y : {0.0, 1.0})
    for (int i = 0; i < sides; ++i)
      mesh.vertices.push_back({std::cos(2 * M_PI * i / sides), y, std::sin(2 * M_PI * i / sides)});
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    mesh.triangles.push_back({i, sides + i, next});
    mesh.triangles.push_back({next, sides + i, sides + next});
  }
  return mesh;
}

double volume_of(const Mesh& mesh) {
  double volume = 0;
  for (const auto& t : mesh.triangles)
    volume += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6;
  return volume;
}

TEST(Capped, ATubeBecomesALongerClosedCan) {
  const Mesh closed = capped(tube(), 0.1);
  EXPECT_TRUE(topology(closed).closed());
  EXPECT_EQ(topology(closed).euler(), 2);
  EXPECT_EQ(topology(closed).components, 1);
  const double disc = 16 * std::sin(2 * M_PI / 32);  // of 32 sides
  EXPECT_NEAR(volume_of(closed), disc * 1.2, 1e-9);  // positive: outward everywhere
  double low = 0, high = 0;
  for (const auto& vertex : closed.vertices) low = std::min(low, vertex.y()), high = std::max(high, vertex.y());
  EXPECT_NEAR(low, -0.1, 1e-12);
  EXPECT_NEAR(high, 1.1, 1e-12);
}

TEST(Capped, WhatIsClosedStays) {
  const Mesh closed = capped(tube(), 0);
  EXPECT_EQ(capped(closed, 0.1).triangles.size(), closed.triangles.size());
}

}  // namespace
}  // namespace dressform
