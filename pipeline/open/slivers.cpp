#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Edge_length_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <utility>

#include "pipeline/geometry/cgal_mesh.h"
#include "pipeline/open/cut.h"

namespace dressform {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;

// The boundary stays where it is: an edge that ends on it collapses to that end, one that joins two of its vertices
// across the surface does not collapse.
struct KeepBoundary {
  template <class Profile>
  boost::optional<CgalKernel::Point_3> operator()(const Profile& profile) const {
    const CgalSurface& surface = profile.surface_mesh();
    const bool first = CGAL::is_border(profile.v0(), surface).has_value();
    const bool second = CGAL::is_border(profile.v1(), surface).has_value();
    if (first && second && !profile.is_v0_v1_a_border() && !profile.is_v1_v0_a_border()) return boost::none;
    if (first != second) return first ? profile.p0() : profile.p1();
    return CGAL::midpoint(profile.p0(), profile.p1());
  }
};

}  // namespace

Mesh without_slivers(const Mesh& open, double shortest_m) {
  CgalSurface surface = to_cgal(open);
  if (surface.number_of_faces() != open.triangles.size()) return open;  // not manifold: nothing is touched
  const sms::Edge_length_stop_predicate<double> stop(shortest_m);
  sms::edge_collapse(surface, stop,
                     CGAL::parameters::get_cost(sms::Edge_length_cost<CgalSurface>()).get_placement(KeepBoundary()));
  return from_cgal(std::move(surface));
}

}  // namespace dressform
