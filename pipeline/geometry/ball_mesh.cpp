#include "pipeline/geometry/ball_mesh.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "pipeline/geometry/mesh_cleanup.h"
#include "pipeline/geometry/mesh_query.h"
#include "pipeline/geometry/submesh.h"
#include "scenes/disjoint_sets.h"

namespace dressform {
namespace {

constexpr double kSnap = 0.3;  // of a step: what the lattice moved less goes back to the surface

// Vertices that the lattice moved a little go back to the surface they were cut from.
void snap_to(const MeshQuery& surface, double farthest_m, Mesh& mesh) {
  tbb::parallel_for(std::size_t{0}, mesh.vertices.size(), [&](std::size_t v) {
    const auto closest = surface.closest(mesh.vertices[v], farthest_m);
    if (closest.triangle >= 0) mesh.vertices[v] = closest.point;
  });
}

}  // namespace

Mesh largest_component(const Mesh& mesh) {
  DisjointSets sets(mesh.vertices.size());
  for (const auto& t : mesh.triangles)
    for (const int k : {1, 2}) sets.join(t[0], t[k]);
  std::vector<int> count(mesh.vertices.size(), 0);
  for (const auto& t : mesh.triangles) ++count[sets.root(t[0])];
  const int best = static_cast<int>(std::max_element(count.begin(), count.end()) - count.begin());
  std::vector<char> kept;
  for (const auto& t : mesh.triangles) kept.push_back(sets.root(t[0]) == best);
  return submesh(mesh, kept);
}

bool ball_shaped(const Mesh& mesh) {
  const Topology shape = topology(mesh);
  return shape.closed() && shape.components == 1 && shape.euler() == 2;
}

Lattice lattice_round(const Mesh& mesh, double step_m) {
  Vector3d low = mesh.vertices.front(), high = low;
  for (const auto& p : mesh.vertices) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return make_lattice(low, high, 6 * step_m, step_m);
}

std::vector<float> distance_field(const Mesh& mesh, const Lattice& lattice) {
  std::vector<std::uint8_t> near(lattice.count(), 0);
  const auto first_cell = [&](double c, int axis) {
    return std::clamp(static_cast<int>(std::floor((c - lattice.origin[axis]) / lattice.step_m)) - 1, 0,
                      lattice.size[axis] - 1);
  };
  for (const auto& t : mesh.triangles) {
    const auto &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Vector3d low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    for (int z = first_cell(low.z(), 2); z <= std::min(first_cell(high.z(), 2) + 3, lattice.size[2] - 1); ++z)
      for (int y = first_cell(low.y(), 1); y <= std::min(first_cell(high.y(), 1) + 3, lattice.size[1] - 1); ++y)
        for (int x = first_cell(low.x(), 0); x <= std::min(first_cell(high.x(), 0) + 3, lattice.size[0] - 1); ++x)
          near[lattice.index(x, y, z)] = 1;
  }
  const auto far = static_cast<float>(4 * lattice.step_m);
  std::vector<float> field(lattice.count(), -far);
  std::vector<std::size_t> front{0};  // the border is outside
  field[0] = far;
  while (!front.empty()) {
    const auto [x, y, z] = lattice.cell(front.back());
    front.pop_back();
    for (int k = 0; k < 6; ++k) {
      std::array<int, 3> to{x, y, z};
      to[k / 2] += k % 2 ? 1 : -1;
      if (to[k / 2] < 0 || to[k / 2] >= lattice.size[k / 2]) continue;
      const std::size_t index = lattice.index(to[0], to[1], to[2]);
      if (near[index] || field[index] > 0) continue;
      field[index] = far;
      front.push_back(index);
    }
  }
  const MeshQuery query(mesh);
  tbb::parallel_for(std::size_t{0}, field.size(), [&](std::size_t i) {
    if (near[i]) field[i] = static_cast<float>(query.signed_distance(lattice.point(i)));
  });
  return field;
}

Mesh ball_like(const Mesh& mesh, const Lattice& lattice, std::vector<float> distances) {
  BallReport report;
  const auto field = ball_field(lattice, std::move(distances), report);
  if (field.empty()) return {};
  Mesh result = edge_collapsed(lattice_surface(lattice, field), lattice.step_m);
  snap_to(MeshQuery(mesh), kSnap * lattice.step_m, result);
  return result;
}

}  // namespace dressform
