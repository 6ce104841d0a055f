#include "pipeline/open/stitch.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "pipeline/open/picked_loop.h"

namespace dressform {
namespace {

// Both loops begin where they are nearest to one another.
void begin_together(const std::vector<Vector3d>& vertices, std::vector<int>& boundary, std::vector<Vector3d>& picked) {
  std::size_t first = 0, nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < picked.size(); ++i)
    for (std::size_t j = 0; j < boundary.size(); ++j)
      if (const double squared = (picked[i] - vertices[boundary[j]]).squaredNorm(); squared < least) {
        least = squared;
        first = i;
        nearest = j;
      }
  std::rotate(picked.begin(), picked.begin() + static_cast<std::ptrdiff_t>(first), picked.end());
  std::rotate(boundary.begin(), boundary.begin() + static_cast<std::ptrdiff_t>(nearest), boundary.end());
}

// For each picked point its place in the boundary, none before the one of the point before, the first at 0: the least
// sum of squared distances, by dynamic programming.
std::vector<int> matched(const std::vector<Vector3d>& vertices, const std::vector<int>& boundary,
                         const std::vector<Vector3d>& picked) {
  const std::size_t n = boundary.size(), m = picked.size();
  std::vector<double> cost(n, std::numeric_limits<double>::infinity());
  cost[0] = 0;
  std::vector<std::vector<int>> from(m, std::vector<int>(n, 0));
  for (std::size_t i = 1; i < m; ++i) {
    int best = 0;
    std::vector<double> next(n);
    for (std::size_t j = 0; j < n; ++j) {
      if (cost[j] < cost[best]) best = static_cast<int>(j);
      from[i][j] = best;
      next[j] = cost[best] + (picked[i] - vertices[boundary[j]]).squaredNorm();
    }
    cost = std::move(next);
  }
  std::vector<int> places(m, 0);
  places[m - 1] = static_cast<int>(std::min_element(cost.begin(), cost.end()) - cost.begin());
  for (std::size_t i = m - 1; i > 1; --i) places[i - 1] = from[i][places[i]];
  return places;
}

}  // namespace

void stitch(Mesh& mesh, std::vector<int> boundary, std::vector<Vector3d> picked) {
  if (boundary.size() < 3 || picked.size() < 3) throw std::invalid_argument("stitch: a loop has three points or more");
  std::vector<Vector3d> along;
  for (const int v : boundary) along.push_back(mesh.vertices[v]);
  if (doubled_area(along).dot(doubled_area(picked)) < 0) std::reverse(picked.begin(), picked.end());
  begin_together(mesh.vertices, boundary, picked);
  std::vector<int> places = matched(mesh.vertices, boundary, picked);
  places.push_back(static_cast<int>(boundary.size()));  // round to the first again

  const int first = static_cast<int>(mesh.vertices.size()), count = static_cast<int>(picked.size());
  mesh.vertices.insert(mesh.vertices.end(), picked.begin(), picked.end());
  const auto b = [&](int place) { return boundary[place % static_cast<int>(boundary.size())]; };
  for (int i = 0; i < count; ++i) {
    const int here = first + i, next = first + (i + 1) % count;
    mesh.triangles.emplace_back(next, b(places[i]), here);
    for (int s = places[i]; s < places[i + 1]; ++s) mesh.triangles.emplace_back(b(s + 1), b(s), next);
  }
}

}  // namespace dressform
