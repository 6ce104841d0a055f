#include "synthetic/capture/light.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

constexpr float shadow_offset_m = 0.0015f;

// Evenly spread over the ball's cross-section (Vogel's spiral).
Vector3f bulb_point(const LightSpec& bulb, const Vector3f& towards, int sample) {
  const Vector3f axis = towards.normalized();
  const Vector3f side = (std::abs(axis.y()) < 0.9f ? Vector3f::UnitY() : Vector3f::UnitX()).cross(axis).normalized();
  const float radius = static_cast<float>(bulb.radius_m) * std::sqrt((sample + 0.5f) / bulb_samples);
  const float angle = 2.3999632f * sample;
  return bulb.position_m.cast<float>() + radius * (std::cos(angle) * side + std::sin(angle) * axis.cross(side));
}

}  // namespace

Lighting make_lighting(const std::vector<LightSpec>& lights, const RoomSpec& room) {
  Lighting result;
  result.bulbs = lights;
  constexpr float room_albedo = 0.5f;
  const double area_m2 =
      2 * (room.width_m * room.depth_m + room.width_m * room.height_m + room.depth_m * room.height_m);
  for (const auto& light : lights)
    result.ambient_rgb +=
        light.intensity_rgb.cast<float>() * static_cast<float>(4 * M_PI / area_m2) * room_albedo / (1 - room_albedo);
  if (lights.empty()) result.ambient_rgb.setOnes();
  return result;
}

DirectLight direct_light(const RayScene& scene, const Lighting& lighting, const PointPacket& points,
                         const Vector3f (&eye)[packet_size], const float (&gloss_exponent)[packet_size],
                         const int (&sample)[packet_size], Coherence coherence) {
  DirectLight result;
  for (int lane = 0; lane < packet_size; ++lane) {
    result.irradiance[lane].setZero();
    result.highlight[lane].setZero();
    result.seen[lane] = 0;
  }
  for (std::size_t bulb = 0; bulb < lighting.bulbs.size(); ++bulb) {
    RayPacket rays;
    float cosine[packet_size];
    bool any = false;
    for (int lane = 0; lane < packet_size; ++lane) {
      if (!points.valid[lane]) continue;
      const Vector3f origin = points.position[lane] + shadow_offset_m * points.geometric_normal[lane];
      const Vector3f centre = lighting.bulbs[bulb].position_m.cast<float>();
      const Vector3f direction = bulb_point(lighting.bulbs[bulb], centre - origin, sample[lane]) - origin;
      cosine[lane] = points.normal[lane].dot(direction.normalized());
      if (cosine[lane] <= 0 || points.geometric_normal[lane].dot(direction) <= 0) continue;
      rays.set(lane, origin, direction, 0.0f,  // up to the bulb's own glass
               1.0f - static_cast<float>(lighting.bulbs[bulb].radius_m) / direction.norm());
      any = true;
    }
    if (!any) continue;
    bool hidden[packet_size];
    scene.occluded(rays, hidden, coherence);
    const Vector3f intensity = lighting.bulbs[bulb].intensity_rgb.cast<float>();
    for (int lane = 0; lane < packet_size; ++lane) {
      if (!rays.valid[lane] || hidden[lane]) continue;
      const Vector3f direction = rays.direction(lane);
      const Vector3f arriving = intensity * (cosine[lane] / direction.squaredNorm());
      result.irradiance[lane] += arriving;
      result.seen[lane] |= 1 << bulb;
      if (gloss_exponent[lane] <= 0) continue;
      const Vector3f half = (direction.normalized() + (eye[lane] - points.position[lane]).normalized()).normalized();
      result.highlight[lane] +=
          arriving * std::pow(std::max(0.0f, half.dot(points.normal[lane])), gloss_exponent[lane]);
    }
  }
  return result;
}

float nominal_exposure(const Lighting& lighting) {
  const Vector3f position(0, 1.35f, 0);
  float brightest = lighting.ambient_rgb.mean();
  for (int step = 0; step < 16; ++step)
    for (const float lift : {0.0f, 0.7f}) {
      const float angle = static_cast<float>(step * M_PI / 8);
      const Vector3f normal = Vector3f(std::sin(angle), lift, std::cos(angle)).normalized();
      Vector3f sum = 2 * lighting.ambient_rgb;  // the first bounce and those after it are about alike
      for (const auto& bulb : lighting.bulbs) {
        const Vector3f to_bulb = bulb.position_m.cast<float>() - position;
        sum +=
            bulb.intensity_rgb.cast<float>() * std::max(0.0f, normal.dot(to_bulb.normalized())) / to_bulb.squaredNorm();
      }
      brightest = std::max(brightest, sum.mean());
    }
  return 1.0f / brightest;
}

}  // namespace dressform
