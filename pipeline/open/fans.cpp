#include "pipeline/open/fans.h"

#include <algorithm>

namespace dressform {
namespace {

constexpr int kTidyRounds = 3;  // of taking ragged triangles away: more only moves the edge

int corner_of(const Vector3i& triangle, int vertex) {
  for (int k = 0; k < 3; ++k)
    if (triangle[k] == vertex) return k;
  return -1;
}

// Those of `around` (kept triangles at the vertex) that hang together across edges at it, from the first one on; taken
// out of `around`.
std::vector<int> next_fan(const Mesh& mesh, const TriangleNeighbours& neighbours, int vertex,
                          std::vector<int>& around) {
  std::vector<int> fan{around.front()};
  around.erase(around.begin());
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const int k = corner_of(mesh.triangles[fan[i]], vertex);
    for (const int side : {k, (k + 2) % 3}) {
      const auto next = std::find(around.begin(), around.end(), neighbours[fan[i]][side]);
      if (next == around.end()) continue;
      fan.push_back(*next);
      around.erase(next);
    }
  }
  return fan;
}

bool goes_round(const Mesh& mesh, const TriangleNeighbours& neighbours, const std::vector<char>& kept, int vertex,
                const std::vector<int>& fan) {
  return std::all_of(fan.begin(), fan.end(), [&](int t) {
    const int k = corner_of(mesh.triangles[t], vertex);
    const int one = neighbours[t][k], other = neighbours[t][(k + 2) % 3];
    return one >= 0 && other >= 0 && kept[one] && kept[other];
  });
}

}  // namespace

std::vector<Fans> vertex_fans(const Mesh& mesh, const TriangleNeighbours& neighbours, const std::vector<char>& kept) {
  std::vector<std::vector<int>> around(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (kept[t])
      for (int k = 0; k < 3; ++k) around[mesh.triangles[t][k]].push_back(static_cast<int>(t));
  std::vector<Fans> fans(mesh.vertices.size());
  for (std::size_t v = 0; v < around.size(); ++v) {
    const int vertex = static_cast<int>(v);
    while (!around[v].empty()) fans[v].triangles.push_back(next_fan(mesh, neighbours, vertex, around[v]));
    fans[v].closed = fans[v].triangles.size() == 1 && goes_round(mesh, neighbours, kept, vertex, fans[v].triangles[0]);
  }
  return fans;
}

std::vector<char> with_single_fans(const Mesh& mesh, const TriangleNeighbours& neighbours, std::vector<char> kept,
                                   const std::function<std::vector<char>(const std::vector<char>&)>& main_piece) {
  bool changed = true;
  for (int round = 0; changed; ++round) {
    changed = false;
    const std::vector<Fans> fans = vertex_fans(mesh, neighbours, kept);
    for (const Fans& each : fans) {
      const auto largest = std::max_element(each.triangles.begin(), each.triangles.end(),
                                            [](const auto& a, const auto& b) { return a.size() < b.size(); });
      for (auto fan = each.triangles.begin(); fan != each.triangles.end(); ++fan)
        if (fan != largest)
          for (const int t : *fan) kept[t] = 0, changed = true;
    }
    for (std::size_t t = 0; t < kept.size() && round < kTidyRounds; ++t) {
      const Vector3i& c = mesh.triangles[t];
      if (kept[t] && !fans[c[0]].closed && !fans[c[1]].closed && !fans[c[2]].closed) kept[t] = 0, changed = true;
    }
    kept = main_piece(kept);
  }
  return kept;
}

}  // namespace dressform
