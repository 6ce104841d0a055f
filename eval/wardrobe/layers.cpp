#include "eval/wardrobe/layers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/geometry/mesh_query.h"

namespace dressform {
namespace {

constexpr double kAbove = 0.7;        // cosine to the normal from which a vertex lies over or under the nearest place
constexpr double kOnIt_m = 1e-5;      // nearer to the cloth there is no direction
constexpr double kNeighbours = 0.75;  // of a neighbour's lift that a vertex takes over, for each ring

// How far each vertex has to be lifted, along what; zero where it is clear.
std::vector<Vector3d> lifts(const Mesh& outer, const MeshQuery& inner, const LayerParams& params) {
  std::vector<Vector3d> result(outer.vertices.size(), Vector3d::Zero());
  tbb::parallel_for(std::size_t{0}, result.size(), [&](std::size_t v) {
    const auto closest = inner.closest(outer.vertices[v], params.reach_m);
    if (closest.triangle < 0) return;
    const Vector3d& normal = inner.normal(closest.triangle);
    const Vector3d off = outer.vertices[v] - closest.point;
    const double height = off.dot(normal);
    if (height >= params.gap_m) return;
    // Beside a rim, not under the cloth.
    if (off.norm() > kOnIt_m && std::abs(height) < kAbove * off.norm()) return;
    result[v] = (params.gap_m - height) * normal;
  });
  return result;
}

// Each vertex is lifted as far as it must, or as its neighbours are, less with every ring.
std::vector<Vector3d> faded(const Mesh& mesh, std::vector<Vector3d> lift, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    std::vector<Vector3d> next = lift;
    for (const Vector3i& t : mesh.triangles)
      for (int k = 0; k < 3; ++k)
        for (const int j : {1, 2})
          if (const Vector3d& other = lift[t[(k + j) % 3]]; kNeighbours * other.norm() > next[t[k]].norm())
            next[t[k]] = kNeighbours * other;
    lift = std::move(next);
  }
  return lift;
}

}  // namespace

Mesh lifted_over(const Mesh& outer, const Mesh& inner, const LayerParams& params) {
  Mesh result = outer;
  if (inner.triangles.empty()) return result;
  const MeshQuery query(inner);
  for (int round = 0; round < params.rounds; ++round) {
    const std::vector<Vector3d> lift = lifts(result, query, params);
    if (std::all_of(lift.begin(), lift.end(), [](const Vector3d& each) { return each.isZero(); })) break;
    const std::vector<Vector3d> moves = faded(result, lift, params.fade_rounds);
    for (std::size_t v = 0; v < moves.size(); ++v) result.vertices[v] += moves[v];
  }
  return result;
}

}  // namespace dressform
