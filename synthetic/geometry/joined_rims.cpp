#include "synthetic/geometry/joined_rims.h"

#include <array>
#include <set>
#include <utility>

#include "scenes/disjoint_sets.h"
#include "scenes/mesh_sides.h"

namespace dressform {
namespace {

constexpr double kSameM = 1e-4;  // two vertices on rims: exporters round to 0.01 mm, cloth has no finer detail

void keep_triangles(TexturedMesh& textured, const std::vector<char>& kept) {
  std::size_t to = 0;
  for (std::size_t t = 0; t < kept.size(); ++t) {
    if (!kept[t]) continue;
    textured.mesh.triangles[to] = textured.mesh.triangles[t];
    if (!textured.corner_uv.empty()) textured.corner_uv[to] = textured.corner_uv[t];
    ++to;
  }
  textured.mesh.triangles.resize(to);
  if (!textured.corner_uv.empty()) textured.corner_uv.resize(to);
}

// Triangles with three different vertices, each only once.
void drop_doubles(TexturedMesh& textured) {
  std::set<std::array<int, 3>> seen;
  std::vector<char> kept;
  for (const Vector3i& t : textured.mesh.triangles) {
    std::array<int, 3> key{t[0], t[1], t[2]};
    std::sort(key.begin(), key.end());
    kept.push_back(key[0] != key[1] && key[1] != key[2] && seen.insert(key).second);
  }
  keep_triangles(textured, kept);
}

std::vector<int> rim_vertices(const Mesh& mesh) {
  std::vector<char> on_rim(mesh.vertices.size(), 0);
  for_edges(sorted_sides(mesh), [&](const TriangleSide* first, const TriangleSide* last) {
    if (last - first == 1) on_rim[first->low] = on_rim[first->high] = 1;
  });
  std::vector<int> result;
  for (int v = 0; v < static_cast<int>(on_rim.size()); ++v)
    if (on_rim[v]) result.push_back(v);
  return result;
}

// Joins each pair of rim vertices that lie within kSameM, but for those in `apart`.
DisjointSets near_vertices(const Mesh& mesh, const std::vector<char>& apart) {
  std::vector<int> order = rim_vertices(mesh);
  const auto& at = mesh.vertices;
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return std::pair(at[a].x(), a) < std::pair(at[b].x(), b); });
  DisjointSets sets(mesh.vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i; j-- > 0 && at[order[i]].x() - at[order[j]].x() <= kSameM;)
      if (!apart[order[i]] && !apart[order[j]] && (at[order[i]] - at[order[j]]).squaredNorm() <= kSameM * kSameM)
        sets.join(order[i], order[j]);
  return sets;
}

// Joining goes vertex by vertex: where an edge would be overused, its ends stay as they are.
void join_rims(TexturedMesh& textured) {
  constexpr int kRounds = 8;
  std::vector<char> apart(textured.mesh.vertices.size(), 0);
  for (int round = 0; round < kRounds; ++round) {
    DisjointSets sets = near_vertices(textured.mesh, apart);
    TexturedMesh joined = textured;
    for (Vector3i& t : joined.mesh.triangles) t = {sets.root(t[0]), sets.root(t[1]), sets.root(t[2])};
    drop_doubles(joined);
    std::vector<char> was_overused(textured.mesh.vertices.size(), 0), overused = was_overused;
    const auto mark = [&](const Mesh& mesh, std::vector<char>& marks) {
      for_edges(sorted_sides(mesh), [&](const TriangleSide* first, const TriangleSide* last) {
        if (last - first > 2) marks[sets.root(first->low)] = marks[sets.root(first->high)] = 1;
      });
    };
    mark(textured.mesh, was_overused);
    mark(joined.mesh, overused);
    bool good = true;
    for (int v = 0; v < static_cast<int>(apart.size()); ++v) {
      const bool newly = overused[sets.root(v)] && !was_overused[sets.root(v)];
      good = good && !(newly && !apart[v]);
      apart[v] = apart[v] || newly;
    }
    if (!good) continue;
    textured = std::move(joined);
    return;
  }
}

}  // namespace

TexturedMesh joined_rims(TexturedMesh textured) {
  drop_doubles(textured);
  join_rims(textured);
  return textured;
}

}  // namespace dressform
