#include "synthetic/geometry/self_intersection.h"

#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <vector>

#include "synthetic/geometry/cgal_mesh.h"

namespace dressform {
namespace {

using Pairs = std::vector<std::pair<ExactSurface::Face_index, ExactSurface::Face_index>>;

// Each triangle by itself, so that it need not be manifold; those without area meet nothing.
void add_loose(ExactSurface& surface, const Mesh& mesh) {
  for (const Vector3i& t : mesh.triangles) {
    const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    if ((b - a).cross(c - a).squaredNorm() == 0) continue;
    const auto vertex = [&](const Vector3d& v) {
      return surface.add_vertex(ExactKernel::Point_3(v.x(), v.y(), v.z()));
    };
    surface.add_face(vertex(a), vertex(b), vertex(c));
  }
}

Pairs meeting(const ExactSurface& surface) {
  Pairs pairs;
  CGAL::Polygon_mesh_processing::self_intersections<CGAL::Sequential_tag>(surface, std::back_inserter(pairs));
  return pairs;
}

}  // namespace

long self_intersections(const Mesh& mesh) { return static_cast<long>(meeting(to_exact(mesh)).size()); }

std::vector<int> crossing_triangles(const Mesh& mesh, const Mesh& other) {
  ExactSurface surface = to_exact(mesh);
  const size_t own = mesh.triangles.size();
  add_loose(surface, other);
  std::set<int> crossing;
  for (const auto& [a, b] : meeting(surface))
    for (const auto face : {a, b})
      if (face.idx() < own && std::min(a.idx(), b.idx()) < own) crossing.insert(static_cast<int>(face.idx()));
  return {crossing.begin(), crossing.end()};
}

}  // namespace dressform
