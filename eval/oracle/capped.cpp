#include "eval/oracle/capped.h"

#include <map>

namespace dressform {
namespace {

// The third corner of the triangle at each directed boundary edge.
std::map<std::pair<int, int>, int> opposite_corners(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> corners;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) corners[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
  return corners;
}

// Mean over a loop's edges, by their length, of the direction in the surface across the edge, outward.
Vector3d way_out(const Mesh& mesh, const std::vector<int>& loop, const std::map<std::pair<int, int>, int>& opposite) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const int a = loop[i], b = loop[(i + 1) % loop.size()];
    const auto corner = opposite.find({a, b});
    if (corner == opposite.end()) continue;
    const Vector3d edge = mesh.vertices[b] - mesh.vertices[a];
    const Vector3d inward = mesh.vertices[corner->second] - mesh.vertices[a];
    const Vector3d across = inward - edge * (inward.dot(edge) / std::max(edge.squaredNorm(), 1e-18));
    if (across.norm() > 0) sum -= edge.norm() * across.normalized();
  }
  return sum.norm() > 0 ? Vector3d(sum.normalized()) : Vector3d::Zero();
}

}  // namespace

Mesh capped(const Mesh& open, double margin_m) {
  Mesh closed = open;
  const auto opposite = opposite_corners(open);
  for (const auto& loop : boundary_loops(open)) {
    const Vector3d step = margin_m * way_out(open, loop, opposite);
    const int ring = static_cast<int>(closed.vertices.size()), count = static_cast<int>(loop.size());
    Vector3d middle = Vector3d::Zero();
    for (const int vertex : loop) {
      closed.vertices.push_back(open.vertices[vertex] + step);
      middle += closed.vertices.back() / count;
    }
    closed.vertices.push_back(middle);
    for (int i = 0; i < count; ++i) {
      const int next = (i + 1) % count, a = loop[i], b = loop[next];
      closed.triangles.push_back({b, a, ring + i});
      closed.triangles.push_back({b, ring + i, ring + next});
      closed.triangles.push_back({ring + next, ring + i, ring + count});
    }
  }
  return closed;
}

}  // namespace dressform
