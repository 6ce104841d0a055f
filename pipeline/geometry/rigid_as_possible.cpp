#include "pipeline/geometry/rigid_as_possible.h"

#include <open3d/geometry/TriangleMesh.h>

#include <algorithm>
#include <stdexcept>

#include "scenes/disjoint_sets.h"

namespace dressform {
namespace {

// Whether each piece of the mesh has a vertex that is put somewhere. Vertices of no triangle are pieces too.
bool all_held(const Mesh& mesh, const std::vector<int>& put) {
  DisjointSets pieces(mesh.vertices.size());
  for (const Vector3i& t : mesh.triangles)
    for (const int k : {1, 2}) pieces.join(t[0], t[k]);
  std::vector<char> held(mesh.vertices.size(), 0);
  for (const int v : put) held[pieces.root(v)] = 1;
  for (std::size_t v = 0; v < held.size(); ++v)
    if (!held[pieces.root(static_cast<int>(v))]) return false;
  return true;
}

}  // namespace

Mesh rigid_as_possible(const Mesh& mesh, const std::vector<int>& put, const std::vector<Vector3d>& places, int rounds) {
  if (put.size() != places.size()) throw std::invalid_argument("rigid_as_possible: one place is needed a vertex");
  for (const int v : put)
    if (v < 0 || v >= static_cast<int>(mesh.vertices.size()))
      throw std::invalid_argument("rigid_as_possible: no such vertex");
  if (mesh.vertices.empty() || !all_held(mesh, put)) return {};
  open3d::geometry::TriangleMesh surface(mesh.vertices, mesh.triangles);
  const auto deformed = surface.DeformAsRigidAsPossible(put, places, static_cast<std::size_t>(rounds));
  const bool found = std::all_of(deformed->vertices_.begin(), deformed->vertices_.end(),
                                 [](const Vector3d& v) { return v.allFinite(); });
  if (!found || deformed->vertices_.size() != mesh.vertices.size()) return {};
  return {deformed->vertices_, mesh.triangles};
}

}  // namespace dressform
