#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "pipeline/open/cut.h"

namespace dressform {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

// The boundary stays where it is: an edge that ends on it collapses to that end, one that joins two of its vertices
// across the surface does not collapse.
struct KeepBoundary {
  template <class Profile>
  boost::optional<Kernel::Point_3> operator()(const Profile& profile) const {
    const Surface& surface = profile.surface_mesh();
    const bool first = CGAL::is_border(profile.v0(), surface).has_value();
    const bool second = CGAL::is_border(profile.v1(), surface).has_value();
    if (first && second && !profile.is_v0_v1_a_border() && !profile.is_v1_v0_a_border()) return boost::none;
    if (first != second) return first ? profile.p0() : profile.p1();
    return CGAL::midpoint(profile.p0(), profile.p1());
  }
};

}  // namespace

Mesh without_slivers(const Mesh& open, double shortest_m) {
  Surface surface;
  for (const Vector3d& v : open.vertices) surface.add_vertex({v.x(), v.y(), v.z()});
  for (const Vector3i& t : open.triangles)
    surface.add_face(Surface::Vertex_index(t[0]), Surface::Vertex_index(t[1]), Surface::Vertex_index(t[2]));
  if (surface.number_of_faces() != open.triangles.size()) return open;  // not manifold: nothing is touched
  const sms::Edge_length_stop_predicate<double> stop(shortest_m);
  sms::edge_collapse(surface, stop,
                     CGAL::parameters::get_cost(sms::Edge_length_cost<Surface>()).get_placement(KeepBoundary()));
  surface.collect_garbage();
  Mesh mesh;
  for (const auto v : surface.vertices()) {
    const auto& p = surface.point(v);
    mesh.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : surface.faces()) {
    Vector3i t;
    int k = 0;
    for (const auto v : surface.vertices_around_face(surface.halfedge(f))) t[k++] = static_cast<int>(v.idx());
    mesh.triangles.push_back(t);
  }
  return mesh;
}

}  // namespace dressform
