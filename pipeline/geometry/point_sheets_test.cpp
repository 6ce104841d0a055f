#include "pipeline/geometry/point_sheets.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dressform {
namespace {

// Points all over a ball, about evenly (the golden spiral), with outward normals.
PointCloud ball_points(int count, double radius_m) {
  PointCloud cloud;
  for (int i = 0; i < count; ++i) {
    const double y = 1 - 2 * (i + 0.5) / count, r = std::sqrt(1 - y * y), turn = i * M_PI * (3 - std::sqrt(5.0));
    cloud.normals.emplace_back(r * std::cos(turn), y, r * std::sin(turn));
    cloud.points.push_back(radius_m * cloud.normals.back());
  }
  return cloud;
}

double area_outwards(const Mesh& mesh) {
  double area = 0;
  for (const Vector3i& t : mesh.triangles) {
    const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Vector3d normal = 0.5 * (b - a).cross(c - a);
    area += normal.dot((a + b + c).normalized());
  }
  return area;
}

constexpr int kPoints = 2000;
constexpr double kRadius_m = 0.1, kArea_m2 = 4 * M_PI * kRadius_m * kRadius_m;

TEST(PointSheets, SpacingOfAnEvenBall) {
  const double spacing = median_spacing_m(ball_points(kPoints, kRadius_m).points);
  EXPECT_NEAR(spacing, std::sqrt(kArea_m2 / kPoints), 0.3 * spacing);
  EXPECT_EQ(median_spacing_m({}), 0);
}

TEST(PointSheets, BallsRollOverABall) {
  const PointCloud cloud = ball_points(kPoints, kRadius_m);
  const double spacing = median_spacing_m(cloud.points);
  const Mesh mesh = ball_pivoting_sheet(cloud, {1.5 * spacing, 3 * spacing});
  EXPECT_NEAR(area_outwards(mesh), kArea_m2, 0.05 * kArea_m2);
  EXPECT_EQ(mesh.triangles, ball_pivoting_sheet(cloud, {1.5 * spacing, 3 * spacing}).triangles);
}

TEST(PointSheets, AlphaShapeOfABallFacesOutwards) {
  const PointCloud cloud = ball_points(kPoints, kRadius_m);
  // Larger than the ball: its hull.
  EXPECT_NEAR(area_outwards(alpha_shape_sheet(cloud, 10 * kRadius_m)), kArea_m2, 0.02 * kArea_m2);
}

TEST(PointSheets, NothingFromNextToNothing) {
  const PointCloud three = ball_points(3, kRadius_m);
  EXPECT_TRUE(ball_pivoting_sheet(three, {0.1}).triangles.empty());
  EXPECT_TRUE(alpha_shape_sheet(three, 0.1).triangles.empty());
}

}  // namespace
}  // namespace dressform
