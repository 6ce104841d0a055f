#pragma once
#include <algorithm>
#include <tuple>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// One side of a triangle: corner k to corner k + 1.
struct TriangleSide {
  int low, high;  // vertices
  int triangle, k;
};

// All sides, those of one edge in a row.
inline std::vector<TriangleSide> sorted_sides(const Mesh& mesh) {
  std::vector<TriangleSide> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
      sides.push_back({low, high, t, k});
    }
  std::sort(sides.begin(), sides.end(), [](const TriangleSide& a, const TriangleSide& b) {
    return std::tie(a.low, a.high, a.triangle, a.k) < std::tie(b.low, b.high, b.triangle, b.k);
  });
  return sides;
}

// Calls visit(first, last) for the sides of every edge.
template <class Visit>
void for_edges(const std::vector<TriangleSide>& sides, const Visit& visit) {
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
    visit(sides.data() + i, sides.data() + end);
  }
}

}  // namespace dressform
