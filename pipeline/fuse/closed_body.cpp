#include "pipeline/fuse/closed_body.h"

#include <utility>

#include "pipeline/fuse/body_ends.h"
#include "pipeline/fuse/body_points.h"
#include "pipeline/fuse/thigh_gap.h"
#include "pipeline/geometry/ball_mesh.h"
#include "pipeline/geometry/poisson.h"

namespace dressform {
namespace {

constexpr double kStep_m = 0.007;         // of the lattice on which solids are changed
constexpr double kSoleSpacing_m = 0.005;  // of the points put under the feet: about as dense as what was measured

}  // namespace

Mesh closed_body(const PointCloud& body, const ClosedBodyOptions& options, const ScanViews& views) {
  if (body.points.empty()) return {};
  PointCloud all = body;
  const PointCloud soles = sole_points(body, kSoleSpacing_m);
  all.points.insert(all.points.end(), soles.points.begin(), soles.points.end());
  all.normals.insert(all.normals.end(), soles.normals.begin(), soles.normals.end());
  const Mesh surface = largest_component(poisson_surface(all, options.poisson_depth));
  if (surface.triangles.empty()) return surface;
  const Lattice lattice = lattice_round(surface, kStep_m);
  Carved solid = carved(lattice, distance_field(surface, lattice), body, views, options.free_space);
  const bool parted = part_thighs(lattice, surface, options.thigh_gap_m, solid.field);
  const bool cut = options.cut_ends && cut_ends(lattice, surface, solid.field);
  return solid.points == 0 && !parted && !cut && ball_shaped(surface)
             ? surface
             : ball_like(surface, lattice, std::move(solid.field));
}

}  // namespace dressform
