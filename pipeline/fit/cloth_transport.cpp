#include "pipeline/fit/cloth_transport.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pipeline/garment/sleeves.h"

namespace dressform {
namespace {

constexpr double kStandsOff = 0.7;  // of an offset's length that is distance from the body; the rest is slant
constexpr int kRoomSteps = 8;
constexpr int kArmRings = 20;                              // of neighbours over which sleeve turns into trunk
constexpr double kRoomFactor = 0.75;                       // of the offset, a step
constexpr double kSnap_m = 0.04, kSnapCosine = 0.5;        // of a moved point of the body to the user's surface
constexpr double kRounding_m = 0.002, kTrusted_m = 0.008;  // offsets so short have no direction; so much more, one
constexpr double kOwn = 0.15, kStay = 0.2, kFromNeighbours = 0.8;  // of a vertex's change in one round of diffusion
constexpr double kPastSleeve_m = 0.04;  // of the arm still counts as clothed: a bin of the sleeve's end

// The body that the garment lies on: without the arms beyond the sleeves, so that a hem beside a hand belongs to the
// hips.
struct ClothedBody {
  Mesh mesh;
  std::vector<char> arm;  // per triangle
};

ClothedBody clothed_body(const GarmentLayout& layout, const StandingBody& naked) {
  const auto bare = exposed_arm_triangles({naked.mesh, naked.landmarks}, layout, kPastSleeve_m);
  ClothedBody result;
  result.mesh.vertices = naked.mesh.vertices;
  for (std::size_t i = 0; i < bare.size(); ++i) {
    if (bare[i]) continue;
    result.mesh.triangles.push_back(naked.mesh.triangles[i]);
    result.arm.push_back(is_arm(naked.landmarks.triangle_parts[i]));
  }
  return result;
}

struct Anchors {
  std::vector<Vector3d> body;    // nearest points of the naked body
  std::vector<double> distance;  // signed, negative inside
  std::vector<Vector3d> normal;  // of the body there
  std::vector<double> arm;       // 0-1, diffused
};

Anchors find_anchors(const Mesh& garment, const ClothedBody& clothed) {
  const MeshQuery surface(clothed.mesh);
  const std::size_t count = garment.vertices.size();
  Anchors anchors{std::vector<Vector3d>(count), std::vector<double>(count), std::vector<Vector3d>(count),
                  std::vector<double>(count, 0)};
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t v) {
    const auto closest = surface.closest(garment.vertices[v]);
    anchors.body[v] = closest.point;
    anchors.distance[v] = surface.signed_distance(garment.vertices[v], closest);
    anchors.normal[v] = surface.normal(closest.triangle);
    anchors.arm[v] = clothed.arm[closest.triangle];
  });
  anchors.arm = diffused_weights(garment, std::move(anchors.arm), kArmRings);
  return anchors;
}

// Each map where it counts, and nothing evaluated that is weighted by zero.
std::vector<Vector3d> blended(const BodyWarp& warp, const std::vector<Vector3d>& points,
                              const std::vector<double>& arm) {
  std::vector<Vector3d> result(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t v) {
    const double w = arm[v];
    if (w <= 0)
      result[v] = warp.core(points[v]);
    else if (w >= 1)
      result[v] = warp.all(points[v]);
    else
      result[v] = w * warp.all(points[v]) + (1 - w) * warp.core(points[v]);
  });
  return result;
}

// How far cloth may stand off `base` towards `out` (unit) before another part of the body is nearer: an offset from an
// arm held out does not fit between the arm and the trunk when it hangs.
double room_for(double offset, const Vector3d& base, const Vector3d& out, const MeshQuery& user_surface) {
  for (int step = 0; step < kRoomSteps; ++step) {
    if (user_surface.closest(base + offset * out).distance >= kStandsOff * offset) break;
    offset *= kRoomFactor;
  }
  return offset;
}

// Where the offset kept at its length would put the vertex.
Vector3d with_offset(const Anchors& anchors, std::size_t v, const Vector3d& cloth, const Vector3d& body,
                     const MeshQuery& user_surface) {
  Vector3d base = body, normal = anchors.normal[v];
  const auto snapped = user_surface.closest(body, kSnap_m);
  if (snapped.triangle >= 0 && user_surface.normal(snapped.triangle).dot(normal) > kSnapCosine) {
    base = snapped.point;
    normal = user_surface.normal(snapped.triangle);
  }
  const double distance = anchors.distance[v];
  Vector3d out = distance < 0 ? Vector3d(body - cloth) : Vector3d(cloth - body);
  // Close to the body the offset's direction is mostly rounding: the normal takes over.
  const double trust = std::clamp((std::abs(distance) - kRounding_m) / kTrusted_m, 0.0, 1.0);
  out = out.norm() > 1e-9 ? Vector3d(trust * out.normalized() + (1 - trust) * normal) : normal;
  out.normalize();
  return base + (distance > 0 ? room_for(distance, base, out, user_surface) : distance) * out;
}

void diffuse(const Mesh& garment, const std::vector<double>& confidence, int rounds, std::vector<Vector3d>& change) {
  // Each vertex holds on to its own change as far as the body is near, and takes the rest from its neighbours.
  const std::vector<Vector3d> wanted = change;
  for (int round = 0; round < rounds; ++round) {
    std::vector<Vector3d> sums(change.size(), Vector3d::Zero());
    std::vector<double> counts(change.size(), 0);
    for (const auto& t : garment.triangles)
      for (int k = 0; k < 3; ++k)
        for (int j : {1, 2}) {
          sums[t[k]] += change[t[(k + j) % 3]];
          counts[t[k]] += 1;
        }
    for (std::size_t v = 0; v < change.size(); ++v) {
      if (counts[v] == 0) continue;
      const double own = kOwn * confidence[v];
      change[v] = own * wanted[v] + (1 - own) * (kStay * change[v] + kFromNeighbours * sums[v] / counts[v]);
    }
  }
}

}  // namespace

Transported transported(const Mesh& garment, const GarmentLayout& layout, const StandingBody& naked,
                        const BodyWarp& warp, const MeshQuery& user_surface, const ClothTransportParams& params) {
  if (garment.vertices.empty()) return {};
  const Anchors anchors = find_anchors(garment, clothed_body(layout, naked));
  std::vector<Vector3d> cloth = blended(warp, garment.vertices, anchors.arm);
  if (params.keep_offset <= 0) return {cloth, anchors.arm};
  const std::vector<Vector3d> body = blended(warp, anchors.body, anchors.arm);
  std::vector<Vector3d> change(cloth.size());
  std::vector<double> confidence(cloth.size());
  tbb::parallel_for(std::size_t{0}, cloth.size(), [&](std::size_t v) {
    change[v] = with_offset(anchors, v, cloth[v], body[v], user_surface) - cloth[v];
    const double far = std::abs(anchors.distance[v]) / params.near_m;
    confidence[v] = 1 / (1 + far * far);
  });
  diffuse(garment, confidence, params.diffusion_rounds, change);
  for (std::size_t v = 0; v < cloth.size(); ++v) cloth[v] += params.keep_offset * change[v];
  return {cloth, anchors.arm};
}

}  // namespace dressform
