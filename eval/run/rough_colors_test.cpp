#include "eval/run/rough_colors.h"

#include <gtest/gtest.h>

namespace dressform {
namespace {

TEST(RoughColors, TakesTheNearestWithinReach) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  PointCloud cloud;
  cloud.points = {{0.9, 0, 0}, {0.01, 0, 0}};
  cloud.colors = {Vector3f(1, 0, 0), Vector3f(0, 0, 1)};
  const auto colors = rough_colors(mesh, cloud, 0.1001);
  EXPECT_EQ(colors[0], Vector3f(0, 0, 1));
  EXPECT_EQ(colors[1], Vector3f(1, 0, 0));
  EXPECT_EQ(colors[2], rough_colors(mesh, {}, 1)[0]) << "nothing is near: the same as without a cloud";
  EXPECT_NE(colors[2], colors[1]);
}

}  // namespace
}  // namespace dressform
