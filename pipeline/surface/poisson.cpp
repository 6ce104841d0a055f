// The thesis's surface (section 3.4.1): Poisson's reconstruction of the aligned points, closed. Kazhdan, Bolitho and
// Hoppe, "Poisson surface reconstruction", SGP 2006, in the screened form of Kazhdan and Hoppe, ACM TOG 2013. The
// thesis took outliers out by hand (tables 12 and 13); statistics and what other views see stand in.
#include "pipeline/geometry/poisson.h"

#include <utility>

#include "pipeline/geometry/ball_mesh.h"
#include "pipeline/surface/closed_cloth.h"

namespace dressform {
namespace {

struct PoissonParams {
  GarmentCloudParams cloud = as_measured();
  int normal_neighbours = 20;
  int depth = 8;
  double scale = 1.25;
  double step_m = 0.006;
  int fewest_points = 300;
};
template <class V>
void fields(V& v, PoissonParams& p) {
  fields(v, p.cloud);
  v("normal_neighbours", p.normal_neighbours, 4, 200, "",
    "least nearest points whose principal components give a normal; more where more lie within 35 mm");
  v("depth", p.depth, 4, 10, "", "of the octree: the thesis's 8");
  v("scale", p.scale, 1.01, 4.0, "", "edge of the octree's cube over the points' largest extent");
  v("step_m", p.step_m, 0.003, 0.03, "m", "of the lattice on which webs and handles are taken out");
  v("fewest_points", p.fewest_points, 50, 100000, "", "a garment with fewer points is left out");
}

// Closes each hole by a fan: where the surface leaves the octree's cube it ends in the plane of the cube's side.
Mesh capped(Mesh mesh) {
  if (topology(mesh).non_manifold_edges) return mesh;
  for (const auto& loop : boundary_loops(mesh)) {
    Vector3d centre = Vector3d::Zero();
    for (const int v : loop) centre += mesh.vertices[v] / static_cast<double>(loop.size());
    const int middle = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(centre);
    for (std::size_t i = 0; i < loop.size(); ++i)
      mesh.triangles.emplace_back(loop[(i + 1) % loop.size()], loop[i], middle);
  }
  return mesh;
}

// One piece without handles: V - F / 2 = 2, as of all of the thesis's meshes. Nobody sees the inner sides of legs and
// sleeves, and the surface closes over what is between them: webs that a view looks through are taken out, and one that
// closes a ring is opened at its thinnest.
Mesh closed_surface(const ClothTask& task, const PoissonParams& params) {
  const Mesh surface = capped(largest_component(poisson_surface(task.support, params.depth, params.scale)));
  if (surface.triangles.empty()) return surface;
  const Lattice lattice = lattice_round(surface, params.step_m);
  std::vector<float> field = distance_field(surface, lattice);
  if (!carved(lattice, task.views, task.body, params.cloud.see_through_m, field) && ball_shaped(surface))
    return surface;
  return ball_like(surface, lattice, std::move(field));
}

ClosedGarments poisson(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                       const Registration& registration, const FilledViews& filled, const GarmentLayouts& segmented,
                       const PoissonParams& params) {
  return closed_cloths(session, calibration, naked, registration, filled, segmented, params.cloud,
                       params.normal_neighbours, params.fewest_points, "surface.poisson",
                       [&](const ClothTask& task) { return closed_surface(task, params); });
}

const Surface::Variant poisson_variant{"poisson", poisson};

}  // namespace
}  // namespace dressform
