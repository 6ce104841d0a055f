#include "synthetic/capture/shading.h"

#include <Eigen/Geometry>

namespace dressform {
namespace {

constexpr float mirror_far_m = 30.0f;

// Looks up the points; their mirrors are told apart by `chrome`.
void look_up(const LitScene& world, const RayPacket& rays, const HitPacket& hits, float footprint_per_m,
             ShadedPacket& out, SurfacePoint (&points)[packet_size], float (&exponent)[packet_size]) {
  for (int lane = 0; lane < packet_size; ++lane) {
    out.albedo[lane].setZero();
    out.direct[lane].setZero();
    out.other[lane].setZero();
    out.seen[lane] = 0;
    exponent[lane] = 0;
    if (hits.surface[lane] < 0) continue;
    const float distance_m = hits.t[lane] * rays.direction(lane).norm();
    points[lane] = world.scene.point(rays, hits, lane, footprint_per_m * distance_m);
    if (points[lane].material->chrome) continue;
    out.points.valid[lane] = true;
    out.points.position[lane] = points[lane].position;
    out.points.normal[lane] = points[lane].normal;
    out.points.geometric_normal[lane] = points[lane].geometric_normal;
    out.albedo[lane] = points[lane].albedo_rgb;
    exponent[lane] = points[lane].material->gloss > 0 ? points[lane].material->gloss_exponent : 0.0f;
  }
}

// Everything but mirrors.
ShadedPacket shade_diffuse(const LitScene& world, const RayPacket& rays, const HitPacket& hits, float footprint_per_m,
                           const int (&bulb_sample)[packet_size], SurfacePoint (&points)[packet_size]) {
  ShadedPacket out;
  float exponent[packet_size];
  look_up(world, rays, hits, footprint_per_m, out, points, exponent);
  Vector3f eye[packet_size];
  for (int lane = 0; lane < packet_size; ++lane) eye[lane] = rays.origin(lane);
  const DirectLight direct =
      direct_light(world.scene, world.lighting, out.points, eye, exponent, bulb_sample, Coherence::coherent);
  for (int lane = 0; lane < packet_size; ++lane) {
    if (!out.points.valid[lane]) continue;
    const Material& material = *points[lane].material;
    out.direct[lane] = direct.irradiance[lane];
    out.seen[lane] = direct.seen[lane];
    out.other[lane] = out.albedo[lane].cwiseProduct(world.indirect.irradiance(world.scene, rays, hits, lane)) +
                      material.emission_rgb + material.gloss * direct.highlight[lane];
  }
  return out;
}

}  // namespace

ShadedPacket shade(const LitScene& world, const RayPacket& rays, const HitPacket& hits, float footprint_per_m,
                   const int (&bulb_sample)[packet_size]) {
  SurfacePoint points[packet_size];
  ShadedPacket out = shade_diffuse(world, rays, hits, footprint_per_m, bulb_sample, points);
  RayPacket bounced;
  bool any = false;
  for (int lane = 0; lane < packet_size; ++lane) {
    if (hits.surface[lane] < 0 || out.points.valid[lane]) continue;
    const Vector3f direction = rays.direction(lane);
    const Vector3f onward = (direction - 2 * direction.dot(points[lane].normal) * points[lane].normal).normalized();
    bounced.set(lane, points[lane].position + 1e-3f * points[lane].geometric_normal, onward, 1e-3f, mirror_far_m);
    any = true;
  }
  if (!any) return out;
  HitPacket hit;
  world.scene.intersect(bounced, hit, Coherence::incoherent);
  SurfacePoint mirrored_points[packet_size];
  const ShadedPacket mirrored = shade_diffuse(world, bounced, hit, 0.02f, bulb_sample, mirrored_points);
  for (int lane = 0; lane < packet_size; ++lane)
    if (bounced.valid[lane])
      out.other[lane] = points[lane].albedo_rgb.cwiseProduct(mirrored.albedo[lane].cwiseProduct(mirrored.direct[lane]) +
                                                             mirrored.other[lane]);
  return out;
}

}  // namespace dressform
