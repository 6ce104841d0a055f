#include "pipeline/fit/body_warp.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "pipeline/garment/sleeves.h"

namespace dressform {
namespace {

constexpr double kMutual = 0.5, kMutual_m = 0.008;  // that the way back may miss by: part of the way, and on top of it
constexpr int kArmRings = 15;                       // of neighbours over which shoulders turn into trunk

struct SurfacePoint {
  Vector3d point, normal;
  BodyPart part;
};

// One vertex of the body for each cell of a lattice: the first in the mesh's order.
std::vector<SurfacePoint> spread_points(const StandingBody& body, double spacing_m) {
  const auto normals = vertex_normals(body.mesh);
  std::vector<BodyPart> parts(body.mesh.vertices.size(), BodyPart::torso);
  for (std::size_t t = 0; t < body.mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) parts[body.mesh.triangles[t][k]] = body.landmarks.triangle_parts[t];
  std::map<std::tuple<long, long, long>, std::size_t> cells;
  for (std::size_t v = 0; v < body.mesh.vertices.size(); ++v) {
    const Vector3d cell = (body.mesh.vertices[v] / spacing_m).array().floor();
    cells.emplace(std::make_tuple(std::lround(cell.x()), std::lround(cell.y()), std::lround(cell.z())), v);
  }
  std::vector<SurfacePoint> points;
  for (const auto& [cell, v] : cells) points.push_back({body.mesh.vertices[v], normals[v], parts[v]});
  return points;
}

Mesh moved(const Mesh& mesh, std::vector<Vector3d> vertices) {
  Mesh result;
  result.vertices = std::move(vertices);
  result.triangles = mesh.triangles;
  return result;
}

RbfField field_of(const std::vector<ControlPair>& pairs, const BodyWarpParams& params) {
  std::vector<Vector3d> controls, targets;
  for (const auto& pair : pairs) {
    controls.push_back(pair.control);
    targets.push_back(pair.target);
  }
  return RbfField(controls, targets, params.kernel, params.smoothing, params.radius_m);
}

SpaceMap map_of(const std::vector<ControlPair>& pairs, bool with_arms, const MakeMap& make) {
  std::vector<Vector3d> controls, targets;
  for (const auto& pair : pairs) {
    if (!with_arms && is_arm(pair.part)) continue;
    controls.push_back(pair.control);
    targets.push_back(pair.target);
  }
  return make(controls, targets);
}

// Places on the user for points of the naked body, where snapping is plausible both ways.
std::vector<ControlPair> snapped_pairs(const StandingBody& naked, const std::vector<SurfacePoint>& points,
                                       const RbfField& field, const MeshQuery& user_surface,
                                       const BodyWarpParams& params) {
  const MeshQuery warped(moved(naked.mesh, field(naked.mesh.vertices)));
  const double least_cosine = std::cos(params.snap_angle_deg * M_PI / 180);
  std::vector<ControlPair> found(points.size());
  std::vector<char> good(points.size(), 0);
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    const Vector3d at = field(points[i].point);
    const auto there = user_surface.closest(at, params.snap_distance_m);
    if (there.triangle < 0) return;
    const auto here = warped.closest(at);
    if (warped.normal(here.triangle).dot(user_surface.normal(there.triangle)) < least_cosine) return;
    const auto back = warped.closest(there.point);
    if ((back.point - at).norm() > kMutual * there.distance + kMutual_m) return;
    found[i] = {points[i].point, there.point, points[i].part};
    good[i] = 1;
  });
  std::vector<ControlPair> pairs;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (good[i]) pairs.push_back(found[i]);
  return pairs;
}

}  // namespace

std::vector<ControlPair> body_pairs(const StandingBody& naked, const MeshQuery& naked_surface, const StandingBody& user,
                                    const MeshQuery& user_surface, const BodyWarpParams& params) {
  const auto landmarks = landmark_pairs(naked, naked_surface, user, user_surface, params.pairs);
  const auto points = spread_points(naked, params.snap_spacing_m);
  std::vector<ControlPair> pairs = landmarks;
  for (int round = 0; round < params.rounds; ++round) {
    const auto snapped = snapped_pairs(naked, points, field_of(pairs, params), user_surface, params);
    pairs = landmarks;
    pairs.insert(pairs.end(), snapped.begin(), snapped.end());
  }
  return pairs;
}

BodyWarp warp_through(const std::vector<ControlPair>& pairs, const MakeMap& make) {
  return {map_of(pairs, true, make), map_of(pairs, false, make), static_cast<int>(pairs.size())};
}

BodyWarp warp_body(const StandingBody& naked, const MeshQuery& naked_surface, const StandingBody& user,
                   const MeshQuery& user_surface, const BodyWarpParams& params) {
  return warp_through(body_pairs(naked, naked_surface, user, user_surface, params),
                      [&](const std::vector<Vector3d>& controls, const std::vector<Vector3d>& targets) {
                        const RbfField field(controls, targets, params.kernel, params.smoothing, params.radius_m);
                        return SpaceMap([field](const Vector3d& point) { return field(point); });
                      });
}

std::vector<double> diffused_weights(const Mesh& mesh, std::vector<double> weights, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    std::vector<double> sums(weights), counts(weights.size(), 1);
    for (const auto& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) {
        sums[t[k]] += weights[t[(k + 1) % 3]];
        counts[t[k]] += 1;
      }
    for (std::size_t v = 0; v < weights.size(); ++v) weights[v] = sums[v] / counts[v];
  }
  return weights;
}

Mesh warped_body(const StandingBody& naked, const BodyWarp& warp) {
  std::vector<double> weights(naked.mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < naked.mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (is_arm(naked.landmarks.triangle_parts[t])) weights[naked.mesh.triangles[t][k]] = 1;
  weights = diffused_weights(naked.mesh, std::move(weights), kArmRings);
  const auto all = warp.all(naked.mesh.vertices), core = warp.core(naked.mesh.vertices);
  std::vector<Vector3d> vertices(all.size());
  for (std::size_t v = 0; v < all.size(); ++v) vertices[v] = weights[v] * all[v] + (1 - weights[v]) * core[v];
  return moved(naked.mesh, std::move(vertices));
}

}  // namespace dressform
