#include "synthetic/geometry/self_intersection.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <vector>

namespace dressform {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Pairs = std::vector<std::pair<Surface::Face_index, Surface::Face_index>>;

Surface surface_of(const Mesh& mesh) {
  Surface surface;
  for (const Vector3d& v : mesh.vertices) surface.add_vertex(Kernel::Point_3(v.x(), v.y(), v.z()));
  for (const Vector3i& t : mesh.triangles) {
    const auto vertex = [&](int k) { return Surface::Vertex_index(static_cast<Surface::size_type>(t[k])); };
    surface.add_face(vertex(0), vertex(1), vertex(2));
  }
  return surface;
}

// Each triangle by itself, so that it need not be manifold; those without area meet nothing.
void add_loose(Surface& surface, const Mesh& mesh) {
  for (const Vector3i& t : mesh.triangles) {
    const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    if ((b - a).cross(c - a).squaredNorm() == 0) continue;
    const auto vertex = [&](const Vector3d& v) { return surface.add_vertex(Kernel::Point_3(v.x(), v.y(), v.z())); };
    surface.add_face(vertex(a), vertex(b), vertex(c));
  }
}

Pairs meeting(const Surface& surface) {
  Pairs pairs;
  CGAL::Polygon_mesh_processing::self_intersections<CGAL::Sequential_tag>(surface, std::back_inserter(pairs));
  return pairs;
}

}  // namespace

long self_intersections(const Mesh& mesh) { return static_cast<long>(meeting(surface_of(mesh)).size()); }

std::vector<int> crossing_triangles(const Mesh& mesh, const Mesh& other) {
  Surface surface = surface_of(mesh);
  const size_t own = mesh.triangles.size();
  add_loose(surface, other);
  std::set<int> crossing;
  for (const auto& [a, b] : meeting(surface))
    for (const auto face : {a, b})
      if (face.idx() < own && std::min(a.idx(), b.idx()) < own) crossing.insert(static_cast<int>(face.idx()));
  return {crossing.begin(), crossing.end()};
}

}  // namespace dressform
