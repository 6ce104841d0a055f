#include "pipeline/geometry/rigid_as_possible.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "pipeline/testing/figure.h"

namespace dressform {
namespace {

// Vertices of the tube's first and last ring.
std::vector<int> ends_of(const Mesh& tube) {
  std::vector<int> ends;
  for (std::size_t v = 0; v < tube.vertices.size(); ++v)
    if (tube.vertices[v].y() < 0.001 || tube.vertices[v].y() > 0.999) ends.push_back(static_cast<int>(v));
  return ends;
}

TEST(RigidAsPossible, ATurnOfTheEndsTurnsTheWhole) {
  const Mesh tube = make_tube(0.1, 0, 1).mesh;
  const Eigen::AngleAxisd turn(0.7, Vector3d(1, 2, 3).normalized());
  const std::vector<int> put = ends_of(tube);
  std::vector<Vector3d> places;
  for (const int v : put) places.push_back(turn * tube.vertices[v] + Vector3d(0.3, 0, 0));
  const Mesh turned = rigid_as_possible(tube, put, places, 60);
  ASSERT_EQ(turned.vertices.size(), tube.vertices.size());
  EXPECT_EQ(turned.triangles, tube.triangles);
  double worst = 0;
  for (std::size_t v = 0; v < tube.vertices.size(); ++v)
    worst = std::max(worst, (turned.vertices[v] - turn * tube.vertices[v] - Vector3d(0.3, 0, 0)).norm());
  EXPECT_LT(worst, 0.02);  // the rounds come ever nearer
  EXPECT_EQ(rigid_as_possible(tube, put, places, 3).vertices, rigid_as_possible(tube, put, places, 3).vertices);
}

TEST(RigidAsPossible, WithoutAnAnswerItIsEmpty) {
  Mesh tube = make_tube(0.1, 0, 1).mesh;
  EXPECT_TRUE(rigid_as_possible(tube, {}, {}, 3).vertices.empty());
  const int last = static_cast<int>(tube.vertices.size());
  for (const Vector3d& v : {Vector3d(1, 0, 0), Vector3d(1, 1, 0), Vector3d(1, 0, 1)}) tube.vertices.push_back(v);
  tube.triangles.emplace_back(last, last + 1, last + 2);
  EXPECT_TRUE(rigid_as_possible(tube, {0}, {Vector3d::Zero()}, 3).vertices.empty());
  EXPECT_THROW(rigid_as_possible(tube, {0}, {}, 3), std::invalid_argument);
  EXPECT_THROW(rigid_as_possible(tube, {last + 3}, {Vector3d::Zero()}, 3), std::invalid_argument);
}

}  // namespace
}  // namespace dressform
