#include "scenes/formats/polygon.h"

#include <gtest/gtest.h>

namespace dressform {
namespace {

using Triangles = std::vector<std::array<int, 3>>;

Vector3d doubled(const std::vector<Vector3d>& p, const std::array<int, 3>& t) {
  return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]);
}

// The letter U, in a plane that is not an axis's.
std::vector<Vector3d> letter_u() {
  std::vector<Vector3d> corners;
  for (const auto& [x, y] :
       std::vector<std::pair<double, double>>{{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}})
    corners.emplace_back(x, 0.6 * y, 0.8 * y);
  return corners;
}

void expect_filled(const std::vector<Vector3d>& corners, const Vector3d& normal, double area) {
  Triangles triangles;
  ASSERT_TRUE(triangulate(corners, triangles));
  double sum = 0;
  for (const auto& t : triangles) {
    EXPECT_GE(doubled(corners, t).dot(normal), 0);
    sum += 0.5 * doubled(corners, t).norm();
  }
  EXPECT_NEAR(sum, area, 1e-9);
}

TEST(Polygon, ConcaveOutlinesAreFilledFromAnyFirstCorner) {
  std::vector<Vector3d> corners = letter_u();
  for (std::size_t first = 0; first < corners.size(); ++first) {
    expect_filled(corners, {0, -0.8, 0.6}, 7);
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  }
  std::reverse(corners.begin(), corners.end());
  expect_filled(corners, {0, 0.8, -0.6}, 7);
}

TEST(Polygon, DartsAreSplitWithinThemselves) {
  std::vector<Vector3d> dart{{0, 0, 0}, {2, 2, 0}, {0, 1, 0}, {-2, 2, 0}};  // reflex at (0, 1)
  for (int first = 0; first < 4; ++first) {
    expect_filled(dart, {0, 0, 1}, 2);
    std::rotate(dart.begin(), dart.begin() + 1, dart.end());
  }
}

TEST(Polygon, CornersMayBeCollinearOrRepeated) {
  expect_filled({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}}, {0, 0, 1}, 4);
  expect_filled({{0, 0, 0}, {2, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {0, 0, 1}, 4);
  // A square hole, reached over a bridge that is walked twice.
  expect_filled(
      {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0}, {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}},
      {0, 0, 1}, 8);
  Triangles triangles;
  EXPECT_TRUE(triangulate({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}}, triangles));
  EXPECT_EQ(triangles.size(), 3u) << "of no area, but joined to their neighbours";
}

TEST(Polygon, OutlinesThatCrossThemselvesAreRefused) {
  Triangles triangles;
  EXPECT_FALSE(triangulate({{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}, {-1, 1, 0}}, triangles));
  EXPECT_TRUE(triangles.empty());
}

}  // namespace
}  // namespace dressform
