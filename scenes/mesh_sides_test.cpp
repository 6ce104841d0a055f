#include "scenes/mesh_sides.h"

#include <gtest/gtest.h>

#include <map>

namespace dressform {
namespace {

// A square of two triangles, and a third that shares their diagonal.
const Mesh kFan{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 3}, {0, 2, 4}}};

TEST(MeshSides, EverySideOfEveryTriangleOnce) {
  const auto sides = sorted_sides(kFan);
  ASSERT_EQ(sides.size(), 9u);
  for (const auto& side : sides) {
    const auto& corners = kFan.triangles[side.triangle];
    EXPECT_LT(side.low, side.high);
    EXPECT_EQ(std::minmax(corners[side.k], corners[(side.k + 1) % 3]), std::minmax(side.low, side.high));
  }
}

TEST(MeshSides, EdgesHaveTheirSidesTogether) {
  std::map<std::pair<int, int>, int> counts;
  const auto sides = sorted_sides(kFan);

  for_edges(sides, [&](const TriangleSide* first, const TriangleSide* last) {
    EXPECT_EQ(counts.count({first->low, first->high}), 0u) << "an edge comes once";
    counts[{first->low, first->high}] = static_cast<int>(last - first);
    int last_triangle = -1;
    for (const auto* side = first; side != last; ++side) {
      EXPECT_GT(side->triangle, last_triangle) << "by triangle: the order is that of the mesh";
      last_triangle = side->triangle;
    }
  });
  EXPECT_EQ(counts.size(), 7u);
  EXPECT_EQ((counts[{0, 2}]), 3);
  EXPECT_EQ((counts[{0, 1}]), 1);
  for_edges({}, [](const TriangleSide*, const TriangleSide*) { FAIL() << "no mesh, no edge"; });
}

}  // namespace
}  // namespace dressform
