#include "pipeline/surface/closed_cloth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "pipeline/geometry/ball_mesh.h"
#include "pipeline/geometry/poisson.h"
#include "pipeline/geometry/winding_number.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr float kCarvedOutside = 0.7f;    // lattice steps outside: what is carved comes to lie there
constexpr double kBeyondEnds_m = 0.05;    // of the covered body beyond the garment's ends; only ends matter here
constexpr double kNearClothEnd_m = 0.03;  // near its ends, and beyond, the surface may close as it likes
constexpr double kSheetBand = 4;          // lattice steps about a sheet in which distances are measured

}  // namespace

GarmentCloudParams as_measured() {
  GarmentCloudParams cloud;
  cloud.smooth_px = 0;
  cloud.outlier_sigma = 2;
  return cloud;
}

// A normal is taken over a stretch of cloth, whatever the images' resolution: over fewer points of a full-size capture
// than lie within this reach, noise turns normals, and Poisson's surface cracks (group 1: F at 10 mm .61 instead of
// .95).
constexpr double kNormalReach_m = 0.035;
constexpr std::size_t kSampledPoints = 64;  // evenly over the list: enough for a median

// The median number of points within the reach of a point.
int points_within_reach(const std::vector<Vector3d>& points) {
  std::vector<double> counts;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kSampledPoints);
  for (std::size_t i = 0; i < points.size(); i += stride)
    counts.push_back(static_cast<double>(std::count_if(points.begin(), points.end(), [&](const Vector3d& p) {
      return (p - points[i]).squaredNorm() < kNormalReach_m * kNormalReach_m;
    })));
  return counts.empty() ? 0 : static_cast<int>(median(counts));
}

PointCloud oriented(PointCloud cloud, const std::vector<DepthView>& views, int least_neighbours) {
  const int neighbours = std::max(least_neighbours, points_within_reach(cloud.points));
  std::vector<Vector3d> towards(cloud.points.size(), Vector3d::Zero());
  for (const DepthView& view : views)
    for (std::size_t i = 0; i < towards.size(); ++i)
      if (cloud.views[i] == view.index) towards[i] = view.model_from_sensor.translation() - cloud.points[i];
  cloud.normals = pca_normals(cloud.points, neighbours, towards);
  return cloud;
}

bool carved(const Lattice& lattice, const std::vector<DepthView>& views, const CoveredBody& body, double see_through_m,
            std::vector<float>& field) {
  std::atomic<bool> any = false;
  tbb::parallel_for(std::size_t{0}, field.size(), [&](std::size_t i) {
    if (field[i] >= 0) return;
    const Vector3d point = lattice.point(i);
    const bool seen_through = std::any_of(views.begin(), views.end(), [&](const DepthView& view) {
      return free_space_violation_m(view, point) > see_through_m;
    });
    if (!seen_through || body.beyond_ends(point) + kBeyondEnds_m > -kNearClothEnd_m) return;
    field[i] = kCarvedOutside * static_cast<float>(lattice.step_m);
    any = true;
  });
  return any;
}

Mesh closed_level_set(const ClothTask& task, const Lattice& lattice, std::vector<float> field, double see_through_m) {
  const Mesh surface = lattice_surface(lattice, field);
  if (surface.triangles.empty()) return {};
  if (!carved(lattice, task.views, task.body, see_through_m, field) && ball_shaped(surface)) return surface;
  return ball_like(surface, lattice, std::move(field));
}

Mesh closed_sheet(const ClothTask& task, const Mesh& sheet, double step_m, double see_through_m) {
  if (sheet.triangles.empty()) return {};
  const Lattice lattice = lattice_round(sheet, step_m);
  const MeshQuery query(sheet);
  const WindingNumber winding(sheet);
  const double far = kSheetBand * step_m;
  std::vector<float> field(lattice.count());
  tbb::parallel_for(std::size_t{0}, field.size(), [&](std::size_t i) {
    const Vector3d point = lattice.point(i);
    const double distance = std::min(far, query.closest(point, far).distance);
    field[i] = static_cast<float>(winding(point) > 0.5 ? -distance : distance);
  });
  carved(lattice, task.views, task.body, see_through_m, field);
  return ball_like(sheet, lattice, std::move(field));
}

ClosedGarments closed_cloths(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                             const Registration& registration, const FilledViews& filled,
                             const GarmentLayouts& segmented, const GarmentCloudParams& cloud_params,
                             int normal_neighbours, int fewest_points, const std::string& variant,
                             const std::function<Mesh(const ClothTask&)>& make) {
  require_known(naked, variant);
  const auto views = depth_views(session, calibration, registration.model_from_sensor);
  const MeshQuery query(naked.body);
  Cloths cloths = gather_cloths(session, filled, segmented, views, query, naked.landmarks, cloud_params, fewest_points);
  ClosedGarments closed;
  for (auto& [name, cloud] : cloths.clouds) {
    ClosedGarment garment;
    garment.support = oriented(std::move(cloud.cloud), views, normal_neighbours);
    garment.layout = cloths.layouts.at(name);
    const CoveredBody body(query, naked.landmarks, garment.layout, kBeyondEnds_m);
    garment.mesh = make({name, garment.support, views, body});
    if (garment.mesh.triangles.empty()) continue;
    take_kind_of_surface(naked.landmarks, garment);
    closed.garments.emplace(name, std::move(garment));
  }
  return with_order_settled(std::move(closed));
}

}  // namespace dressform
