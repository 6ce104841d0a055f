#include "pipeline/geometry/point_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace dressform {
namespace {

// The corners of a grid a unit apart, 0 to 4 along each axis; point i is (i / 25, i / 5 % 5, i % 5).
std::vector<Vector3d> unit_grid() {
  std::vector<Vector3d> points;
  for (int i = 0; i < 125; ++i) points.emplace_back(i / 25, i / 5 % 5, i % 5);
  return points;
}

TEST(PointTree, FindsTheNearestCornerOfAGrid) {
  const auto points = unit_grid();
  const PointTree tree(points);
  std::uint32_t index = 0;
  double squared = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_TRUE(tree.nearest(points[i] + Vector3d(0.3, -0.2, 0.1), index, squared));
    EXPECT_EQ(index, i);
    EXPECT_NEAR(squared, 0.14, 1e-12);
  }
}

TEST(PointTree, NearestDistancesAscendAndAreThoseOfAGrid) {
  const auto points = unit_grid();
  const PointTree tree(points);
  std::vector<double> squared;
  ASSERT_EQ(tree.nearest_squared({2, 2, 2}, 8, squared), 8u);  // itself, six neighbours, one across an edge
  EXPECT_EQ(squared, (std::vector<double>{0, 1, 1, 1, 1, 1, 1, 2}));
  EXPECT_EQ(tree.nearest_squared({2, 2, 2}, 500, squared), 125u);
  EXPECT_TRUE(std::is_sorted(squared.begin(), squared.begin() + 125));
}

TEST(PointTree, OfNoPointsOrAPointThatIsNoneFindsNothing) {
  const std::vector<Vector3d> none;
  std::uint32_t index = 7;
  double squared = 7;
  EXPECT_FALSE(PointTree(none).nearest({0, 0, 0}, index, squared));
  const auto points = unit_grid();
  EXPECT_FALSE(PointTree(points).nearest({0, 0, std::numeric_limits<double>::quiet_NaN()}, index, squared));
  EXPECT_EQ(index, 7u);
  EXPECT_EQ(squared, 7);
}

}  // namespace
}  // namespace dressform
