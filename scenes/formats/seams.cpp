#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>

#include "scenes/formats/file_mesh.h"

namespace dressform {
namespace {

std::vector<char> boundary_vertices(const Mesh& mesh) {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) edges.emplace_back(std::minmax(t[k], t[(k + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  std::vector<char> result(mesh.vertices.size(), 0);
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    if (end - i == 1) result[edges[i].first] = result[edges[i].second] = 1;
  }
  return result;
}

Mesh renumbered(const Mesh& mesh, const std::vector<int>& new_from_old) {
  Mesh result;
  result.vertices.resize(mesh.vertices.size());
  for (const auto& t : mesh.triangles) {
    const Vector3i joined(new_from_old[t[0]], new_from_old[t[1]], new_from_old[t[2]]);
    if (joined[0] != joined[1] && joined[1] != joined[2] && joined[2] != joined[0]) result.triangles.push_back(joined);
  }
  return result;
}

}  // namespace

std::vector<int> joined_seams(const Mesh& split) {
  const auto place = [&](int v) {
    const Vector3d& p = split.vertices[v];
    return std::make_tuple(p.x(), p.y(), p.z());
  };
  const std::vector<char> on_boundary = boundary_vertices(split);
  std::vector<int> order;
  for (int v = 0; v < static_cast<int>(split.vertices.size()); ++v)
    if (on_boundary[v]) order.push_back(v);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const auto place_a = place(a), place_b = place(b);
    return place_a != place_b ? place_a < place_b : a < b;
  });
  std::vector<int> first(split.vertices.size());
  std::iota(first.begin(), first.end(), 0);
  for (std::size_t i = 1; i < order.size(); ++i)
    if (place(order[i]) == place(order[i - 1])) first[order[i]] = first[order[i - 1]];

  std::vector<int> result(first.size());
  int next = 0;
  for (std::size_t v = 0; v < first.size(); ++v)
    result[v] = first[v] == static_cast<int>(v) ? next++ : result[first[v]];
  if (topology(renumbered(split, result)).non_manifold_edges > topology(split).non_manifold_edges)
    std::iota(result.begin(), result.end(), 0);
  return result;
}

}  // namespace dressform
