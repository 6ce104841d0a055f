#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/geometry/lattice.h"
#include "pipeline/geometry/mesh_cleanup.h"
#include "pipeline/surface/covered_body.h"
#include "pipeline/surface/extrapolated.h"
#include "pipeline/surface/garment_cloud.h"
#include "pipeline/surface/leg_hulls.h"
#include "pipeline/surface/offset_field.h"
#include "pipeline/surface/surface.h"
#include "pipeline/surface/tucked.h"

namespace dressform {
namespace {

struct LayerParams {
  GarmentCloudParams cloud;
  double step_m = 0.006;
  double kernel_m = 0.009;
  double reach_m = 0.018;
  double stiffness = 6.0;
  int sweeps = 12;
  double margin_m = 0.05;
  double carve_m = 0.03;
  double end_m = 0.03;
  double edge_m = 0.008;
  double gap_m = 0.006;
  double clearance_m = 0.0015;
  double leg_slack_m = 0.007;
  int fewest_points = 300;
};
template <class V>
void fields(V& v, LayerParams& p) {
  fields(v, p.cloud);
  v("step_m", p.step_m, 0.003, 0.03, "m", "edge of one lattice cell");
  v("kernel_m", p.kernel_m, 0.002, 0.03, "m", "sigma, along the surface, of the average over points");
  v("reach_m", p.reach_m, 0.006, 0.08, "m", "how far off the surface points say how far off it is");
  v("stiffness", p.stiffness, 0.1, 100.0, "", "weight of the points against the smoothness of the ease");
  v("sweeps", p.sweeps, 2, 200, "", "relaxation sweeps on every lattice of the pyramid");
  v("margin_m", p.margin_m, 0.01, 0.2, "m", "how far the closed surface runs on beyond the ends of the garment");
  v("carve_m", p.carve_m, 0.005, 0.2, "m", "space this far in front of what a view sees is empty");
  v("end_m", p.end_m, 0.0, 0.2, "m", "this close to a garment's end, space that views look through stays as it is");
  v("edge_m", p.edge_m, 0.003, 0.05, "m", "edges of the mesh shorter than this are collapsed");
  v("gap_m", p.gap_m, 0.0, 0.05, "m", "cloth beneath another garment stays this far inside it where it is hidden");
  v("clearance_m", p.clearance_m, 0.0, 0.02, "m", "cloth stays this far off the naked body");
  v("leg_slack_m", p.leg_slack_m, 0.0, 0.2, "m", "how far trousers bulge between the legs beyond a taut fit");
  v("fewest_points", p.fewest_points, 50, 100000, "", "a garment with fewer points is left out");
}

// A lattice with, at each point, the distance to the covered body: exact near it, interpolated elsewhere.
struct Space {
  Lattice lattice;
  std::vector<float> body_distance;
  std::vector<std::uint8_t> domain;  // where the surface can be
};

std::vector<float> distances(const Lattice& lattice, const CoveredBody& body) {
  std::vector<float> result(lattice.count());
  tbb::parallel_for(0, lattice.size[2], [&](int z) {
    for (int y = 0; y < lattice.size[1]; ++y)
      for (int x = 0; x < lattice.size[0]; ++x)
        result[lattice.index(x, y, z)] = static_cast<float>(body.signed_distance(lattice.point(x, y, z)));
  });
  return result;
}

double interpolated(const Lattice& lattice, const std::vector<float>& values, const Vector3d& point) {
  const Vector3d at = (point - lattice.origin) / lattice.step_m;
  int base[3];
  double part[3];
  for (int k = 0; k < 3; ++k) {
    base[k] = std::clamp(static_cast<int>(std::floor(at[k])), 0, lattice.size[k] - 2);
    part[k] = std::clamp(at[k] - base[k], 0.0, 1.0);
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double w = 1;
    for (int k = 0; k < 3; ++k) w *= corner >> k & 1 ? part[k] : 1 - part[k];
    sum += w * values[lattice.index(base[0] + (corner & 1), base[1] + (corner >> 1 & 1), base[2] + (corner >> 2 & 1))];
  }
  return sum;
}

Space make_space(const CoveredBody& body, const PointCloud& cloud, const LayerParams& params) {
  Vector3d low = body.low(), high = body.high();
  for (const Vector3d& p : cloud.points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Space space;
  space.lattice = make_lattice(low, high, params.reach_m + 4 * params.step_m, params.step_m);
  double farthest = 0;
  for (const Vector3d& p : cloud.points) farthest = std::max(farthest, body.signed_distance(p));
  const double limit = farthest + params.reach_m + 2 * params.step_m;

  const Lattice coarse = make_lattice(low, high, params.reach_m + 8 * params.step_m, 4 * params.step_m);
  const std::vector<float> rough = distances(coarse, body);
  const double slack = std::sqrt(3.0) * coarse.step_m;
  space.body_distance.resize(space.lattice.count());
  space.domain.resize(space.lattice.count());
  tbb::parallel_for(0, space.lattice.size[2], [&](int z) {
    for (int y = 0; y < space.lattice.size[1]; ++y) {
      double bound = std::numeric_limits<double>::infinity();  // the neighbour's distance and a step
      for (int x = 0; x < space.lattice.size[0]; ++x) {
        const Vector3d point = space.lattice.point(x, y, z);
        double distance = interpolated(coarse, rough, point);
        if (distance < limit + slack && distance > -params.reach_m - slack) {
          distance = body.signed_distance(point, bound);
          bound = std::abs(distance) + 1.001 * params.step_m;
        } else {
          bound = std::numeric_limits<double>::infinity();
        }
        const std::size_t at = space.lattice.index(x, y, z);
        space.body_distance[at] = static_cast<float>(distance);
        space.domain[at] = distance < limit && distance > -params.reach_m - 2 * params.step_m;
      }
    }
  });
  return space;
}

// Where the field lies inside but some view looks through: the surface has to give way there.
// Near and beyond the ends of the garment it runs on where there is no cloth any more: views that look through there
// say nothing, and would bend the cloth inwards up to its rim.
void carve(const Space& space, const CoveredBody& body, const std::vector<DepthView>& views,
           const std::vector<float>& ease, const LayerParams& params, LatticeData& data) {
  const float outside = static_cast<float>(0.7 * space.lattice.step_m);
  tbb::parallel_for(0, space.lattice.size[2], [&](int z) {
    for (int y = 0; y < space.lattice.size[1]; ++y)
      for (int x = 0; x < space.lattice.size[0]; ++x) {
        const std::size_t at = space.lattice.index(x, y, z);
        if (!space.domain[at] || space.body_distance[at] < 0.002f) continue;
        if (space.body_distance[at] - ease[at] > outside) continue;
        const Vector3d point = space.lattice.point(x, y, z);
        for (const DepthView& view : views)
          if (free_space_violation_m(view, point) > params.carve_m) {
            if (body.beyond_ends(point) + params.margin_m > -params.end_m) break;
            data.value[at] = space.body_distance[at] - outside;
            data.weight[at] = std::max(data.weight[at], 0.5f);
            break;
          }
      }
  });
}

// The closed garment that is worn over another one, and the height of its lower end: above it, it hides what is
// beneath.
struct Outer {
  MeshQuery closed;
  double bottom_y = 0;
};

// Where the garment beneath has to end at the latest: a gap inside the outer one, but never inside the body. Negative
// inside.
double beneath(const Outer& outer, const Vector3d& point, double body_distance, double gap_m) {
  constexpr double kClearance_m = 0.002;
  if (point.y() < outer.bottom_y) return -std::numeric_limits<double>::infinity();
  return std::min(outer.closed.signed_distance(point) + gap_m, body_distance - kClearance_m);
}

// Negative inside the garment taken as a solid: within the layer, its ends and the legs' hulls, beneath what is worn
// over it, and not in the slits that keep apart what goes round each limb.
std::vector<float> solid(const Space& space, const CoveredBody& body, const LegHulls& hulls,
                         const std::vector<float>& ease, const std::optional<Outer>& outer, const LayerParams& params) {
  const auto least = static_cast<float>(params.clearance_m);
  const double slit_m = 0.75 * space.lattice.step_m;  // half its width: no lattice point is jumped over
  std::vector<float> field(space.lattice.count());
  tbb::parallel_for(0, space.lattice.size[2], [&](int z) {
    for (int y = 0; y < space.lattice.size[1]; ++y)
      for (int x = 0; x < space.lattice.size[0]; ++x) {
        const std::size_t at = space.lattice.index(x, y, z);
        double value = space.body_distance[at] - (space.domain[at] ? std::max(ease[at], least) : 0.0f);
        if (value < space.lattice.step_m) {
          const Vector3d point = space.lattice.point(x, y, z);
          value = std::max(value, body.beyond_ends(point));
          const double slack = space.body_distance[at] - least;  // hulls are coarse: they never cut into the body
          value = std::max(value, std::min(slack, hulls.beyond(point) - params.leg_slack_m));
          if (outer && value < space.lattice.step_m)
            value = std::max(value, beneath(*outer, point, space.body_distance[at], params.gap_m));
          if (space.domain[at] && value < space.lattice.step_m && space.body_distance[at] > 0)
            value = std::max(value, slit_m - body.from_crevice(point, slit_m));
        }
        field[at] = static_cast<float>(value);
      }
  });
  return field;
}

std::optional<ClosedGarment> make_garment(const std::string& name, GarmentCloud cloud, const GarmentExtent& extent,
                                          const std::optional<Outer>& outer, const std::vector<DepthView>& views,
                                          const MeshQuery& naked, const BodyLimbs& limbs, const LayerParams& params) {
  const CoveredBody body(naked, limbs, name, extent, params.margin_m);
  const GarmentCloud carried = extrapolated(cloud, name, extent, naked, limbs, params.margin_m);
  const Space space = make_space(body, carried.cloud, params);

  LatticeData data = plane_distances(space.lattice, carried, cloud.smoothing * params.kernel_m, params.reach_m);
  for (std::size_t i = 0; i < data.value.size(); ++i) data.value[i] = space.body_distance[i] - data.value[i];
  std::vector<float> ease = diffuse(space.lattice, data, space.domain, params.stiffness, params.sweeps);
  carve(space, body, views, ease, params, data);
  ease = diffuse(space.lattice, data, space.domain, params.stiffness, 2 * params.sweeps, ease);

  const LegHulls hulls(carried.cloud, naked.mesh(), limbs, extent, params.margin_m);
  BallReport report;
  std::vector<float> field = ball_field(space.lattice, solid(space, body, hulls, ease, outer, params), report);
  if (field.empty()) return {};
  ClosedGarment garment;
  garment.mesh = edge_collapsed(lattice_surface(space.lattice, field), params.edge_m);
  garment.support = std::move(cloud.cloud);
  return garment;
}

// The garment as a layer round the body: its ease, the distance off the covered part of the naked body, is known where
// views saw cloth and harmonic in between; space that a view sees through is carved; what is inside is shaped into a
// ball (no webs between arm and torso that close a ring) and its surface is taken with marching tetrahedra.
ClosedGarments layer(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                     const Registration& registration, const FilledViews& filled, const LayerParams& params) {
  const BodyLimbs limbs = find_limbs(naked.body);
  const MeshQuery query(naked.body);
  const std::vector<DepthView> views = depth_views(session, calibration, registration);
  std::map<std::string, GarmentCloud> clouds;
  std::map<std::string, GarmentExtent> extents;
  for (const auto& each : filled.garments) {
    GarmentCloud cloud = garment_cloud(each.first, filled, views, session, query, limbs, params.cloud);
    if (static_cast<int>(cloud.cloud.points.size()) < params.fewest_points) continue;
    extents.emplace(each.first, garment_extent(each.first, cloud.cloud, query, limbs));
    clouds.emplace(each.first, std::move(cloud));
  }
  const bool both = extents.count("top") && extents.count("bottom");
  const bool tucked = both && is_tucked(clouds["top"].cloud, clouds["bottom"].cloud, query, limbs);
  if (both && !tucked) extents["bottom"] = up_to_the_waist(extents["bottom"], extents["top"], limbs);
  ClosedGarments closed;
  std::optional<Outer> outer;
  for (const char* name : {"top", "bottom"}) {  // the top hangs over the bottom, unless it is tucked in
    const auto cloud = clouds.find(name);
    if (cloud == clouds.end()) continue;
    auto garment = make_garment(name, std::move(cloud->second), extents[name], outer, views, query, limbs, params);
    if (!garment) continue;
    if (!tucked) outer.emplace(Outer{MeshQuery(garment->mesh), extents[name].bottom_y});
    closed.garments.emplace(name, std::move(*garment));
  }
  closed.tucked = tucked && closed.garments.size() == 2;
  return closed;
}

const Surface::Variant layer_variant{"layer", layer};

}  // namespace
}  // namespace dressform
