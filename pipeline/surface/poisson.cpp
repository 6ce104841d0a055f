// The thesis's surface (section 3.4.1): Poisson's reconstruction of the aligned points, closed. Kazhdan, Bolitho and
// Hoppe, "Poisson surface reconstruction", SGP 2006, in the screened form of Kazhdan and Hoppe, ACM TOG 2013. The
// thesis took outliers out by hand (tables 12 and 13); statistics and what other views see stand in.
#include "pipeline/geometry/poisson.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "pipeline/geometry/ball_mesh.h"
#include "pipeline/surface/cloths.h"
#include "pipeline/surface/covered_body.h"

namespace dressform {
namespace {

constexpr float kOutside = 0.7f;     // lattice steps outside: what is carved comes to lie there
constexpr double kMargin_m = 0.05;   // of the covered body beyond the garment's ends; only ends matter here
constexpr double kNearEnd_m = 0.03;  // near its ends, and beyond, the surface may close as it likes

GarmentCloudParams as_measured() {
  GarmentCloudParams cloud;
  cloud.smooth_px = 0;
  cloud.outlier_sigma = 2;
  return cloud;
}

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
  v("normal_neighbours", p.normal_neighbours, 4, 200, "", "nearest points whose principal components give a normal");
  v("depth", p.depth, 4, 10, "", "of the octree: the thesis's 8");
  v("scale", p.scale, 1.01, 4.0, "", "edge of the octree's cube over the points' largest extent");
  v("step_m", p.step_m, 0.003, 0.03, "m", "of the lattice on which webs and handles are taken out");
  v("fewest_points", p.fewest_points, 50, 100000, "", "a garment with fewer points is left out");
}

// The points with the normals that the thesis's tools give them, each towards the sensor that saw it.
PointCloud oriented(PointCloud cloud, const std::vector<DepthView>& views, int neighbours) {
  std::vector<Vector3d> towards(cloud.points.size(), Vector3d::Zero());
  for (const DepthView& view : views)
    for (std::size_t i = 0; i < towards.size(); ++i)
      if (cloud.views[i] == view.index) towards[i] = view.model_from_sensor.translation() - cloud.points[i];
  cloud.normals = pca_normals(cloud.points, neighbours, towards);
  return cloud;
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

// Takes out of the field (negative inside) what a view looks through between the garment's ends. Whether it did.
bool carved(const Lattice& lattice, const std::vector<DepthView>& views, const CoveredBody& body, double margin_m,
            std::vector<float>& field) {
  std::atomic<bool> any = false;
  tbb::parallel_for(std::size_t{0}, field.size(), [&](std::size_t i) {
    if (field[i] >= 0) return;
    const Vector3d point = lattice.point(i);
    const bool seen_through = std::any_of(views.begin(), views.end(), [&](const DepthView& view) {
      return free_space_violation_m(view, point) > margin_m;
    });
    if (!seen_through || body.beyond_ends(point) + kMargin_m > -kNearEnd_m) return;
    field[i] = kOutside * static_cast<float>(lattice.step_m);
    any = true;
  });
  return any;
}

// One piece without handles: V - F / 2 = 2, as of all of the thesis's meshes. Nobody sees the inner sides of legs and
// sleeves, and the surface closes over what is between them: webs that a view looks through are taken out, and one that
// closes a ring is opened at its thinnest.
Mesh closed_surface(const PointCloud& cloud, const std::vector<DepthView>& views, const CoveredBody& body,
                    const PoissonParams& params) {
  const Mesh surface = capped(largest_component(poisson_surface(cloud, params.depth, params.scale)));
  if (surface.triangles.empty()) return surface;
  const Lattice lattice = lattice_round(surface, params.step_m);
  std::vector<float> field = distance_field(surface, lattice);
  if (!carved(lattice, views, body, params.cloud.see_through_m, field) && ball_shaped(surface)) return surface;
  return ball_like(surface, lattice, std::move(field));
}

ClosedGarments poisson(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                       const Registration& registration, const FilledViews& filled, const GarmentLayouts& segmented,
                       const PoissonParams& params) {
  require_known(naked, "surface.poisson");
  const auto views = depth_views(session, calibration, registration.model_from_sensor);
  const MeshQuery query(naked.body);
  Cloths cloths =
      gather_cloths(session, filled, segmented, views, query, naked.landmarks, params.cloud, params.fewest_points);
  ClosedGarments closed;
  for (auto& [name, cloud] : cloths.clouds) {
    ClosedGarment garment;
    garment.support = oriented(std::move(cloud.cloud), views, params.normal_neighbours);
    garment.layout = cloths.layouts.at(name);
    const CoveredBody body(query, naked.landmarks, garment.layout, kMargin_m);
    garment.mesh = closed_surface(garment.support, views, body, params);
    if (garment.mesh.triangles.empty()) continue;
    take_kind_of_surface(naked.landmarks, garment);
    closed.garments.emplace(name, std::move(garment));
  }
  return with_order_settled(std::move(closed));
}

const Surface::Variant poisson_variant{"poisson", poisson};

}  // namespace
}  // namespace dressform
