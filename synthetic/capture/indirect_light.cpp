#include "synthetic/capture/indirect_light.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace dressform {
namespace {

constexpr int gather_rays = 128;
constexpr float offset_m = 0.0015f;
constexpr double finest_cell_m = 0.03;

// Cosine-weighted directions about +z (Vogel's spiral).
std::array<Vector3f, gather_rays> gather_directions() {
  std::array<Vector3f, gather_rays> result;
  for (int i = 0; i < gather_rays; ++i) {
    const float radius = std::sqrt((i + 0.5f) / gather_rays), angle = 2.3999632f * i;
    result[i] = {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - radius * radius)};
  }
  return result;
}

// Light sent by what sixteen directions meet. A bright spot near a bulb counts no more than `limit`: it would stamp the
// pattern of the directions on the walls.
Vector3f gather_packet(const RayScene& scene, const Lighting& lighting, const Vector3f& origin, const RayPacket& rays) {
  const float limit = 6 * lighting.ambient_rgb.maxCoeff();
  HitPacket hits;
  scene.intersect(rays, hits, Coherence::incoherent);
  PointPacket points;
  std::array<Vector3f, packet_size> albedo;
  Vector3f eye[packet_size];
  int sample[packet_size];
  const float no_gloss[packet_size] = {};
  for (int lane = 0; lane < packet_size; ++lane) {
    sample[lane] = lane % bulb_samples;
    eye[lane] = origin;
    if (hits.surface[lane] < 0) continue;
    const SurfacePoint point = scene.point(rays, hits, lane, 0.1f);
    points.valid[lane] = true;
    points.position[lane] = point.position;
    points.normal[lane] = point.normal;
    points.geometric_normal[lane] = point.geometric_normal;
    albedo[lane] = point.albedo_rgb;
  }
  const DirectLight direct = direct_light(scene, lighting, points, eye, no_gloss, sample, Coherence::incoherent);
  Vector3f sum = Vector3f::Zero();
  for (int lane = 0; lane < packet_size; ++lane) {
    if (!points.valid[lane]) {
      sum += lighting.ambient_rgb;
      continue;
    }
    const Vector3f arriving = direct.irradiance[lane].cwiseMin(limit) + lighting.ambient_rgb;
    sum += albedo[lane].cwiseProduct(arriving);
  }
  return sum;
}

// Mean of what arrives over the hemisphere, in irradiance units.
Vector3f gathered(const RayScene& scene, const Lighting& lighting, const Vector3f& position, const Vector3f& normal) {
  static const auto directions = gather_directions();
  const Eigen::Quaternionf turn = Eigen::Quaternionf::FromTwoVectors(Vector3f::UnitZ(), normal);
  const Vector3f origin = position + offset_m * normal;
  Vector3f sum = Vector3f::Zero();
  for (int first = 0; first < gather_rays; first += packet_size) {
    RayPacket rays;
    for (int lane = 0; lane < packet_size; ++lane)
      rays.set(lane, origin, turn * directions[first + lane], 1e-3f, 100.0f);
    sum += gather_packet(scene, lighting, origin, rays);
  }
  return sum / gather_rays;
}

// Vertices of one cell of space whose normals agree, and the light at their middle.
struct Place {
  Vector3f position = Vector3f::Zero(), normal = Vector3f::Zero(), light = Vector3f::Zero();
  int count = 0;
};
using Cell = std::array<int, 3>;

class Places {
 public:
  Places(const Mesh& mesh, const std::vector<Vector3f>& normals) : cell_m_(cell_size(mesh)) {
    std::map<std::array<int, 4>, int> index;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const Vector3f position = mesh.vertices[i].cast<float>();
      const Cell cell = cell_of(position);
      const int octant = (normals[i].x() > 0) + 2 * (normals[i].y() > 0) + 4 * (normals[i].z() > 0);
      const auto [entry, added] = index.try_emplace({cell[0], cell[1], cell[2], octant}, places_.size());
      if (added) {
        by_cell_[cell].push_back(entry->second);
        places_.emplace_back();
      }
      Place& place = places_[entry->second];
      place.position += position;
      place.normal += normals[i];
      ++place.count;
    }
    for (auto& place : places_) {
      place.position /= place.count;
      place.normal = place.normal.norm() > 1e-6f ? Vector3f(place.normal.normalized()) : Vector3f::UnitY();
    }
  }

  std::vector<Place>& list() { return places_; }

  Vector3f light_at(const Vector3f& position, const Vector3f& normal) const {
    const Cell centre = cell_of(position);
    const float spread = 1 / (2 * 0.49f * static_cast<float>(cell_m_ * cell_m_));
    Vector3f sum = Vector3f::Zero();
    float weights = 1e-12f;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz) {
          const auto found = by_cell_.find({centre[0] + dx, centre[1] + dy, centre[2] + dz});
          if (found == by_cell_.end()) continue;
          for (const int i : found->second) {
            const float agreement = std::max(0.001f, places_[i].normal.dot(normal));
            const float weight =
                agreement * agreement * std::exp(-spread * (places_[i].position - position).squaredNorm());
            sum += weight * places_[i].light;
            weights += weight;
          }
        }
    return sum / weights;
  }

 private:
  // Large enough for some vertices each, small enough for the shadow in an armpit.
  static double cell_size(const Mesh& mesh) {
    double length_m = 0;
    for (const auto& t : mesh.triangles) length_m += (mesh.vertices[t[0]] - mesh.vertices[t[1]]).norm();
    return std::max(finest_cell_m, mesh.triangles.empty() ? 0.0 : 1.6 * length_m / mesh.triangles.size());
  }
  Cell cell_of(const Vector3f& position) const {
    Cell cell;
    for (int c = 0; c < 3; ++c) cell[c] = static_cast<int>(std::floor(position[c] / cell_m_));
    return cell;
  }
  double cell_m_;
  std::vector<Place> places_;
  std::map<Cell, std::vector<int>> by_cell_;
};

}  // namespace

IndirectLight::IndirectLight(const RayScene& scene, const Lighting& lighting) {
  for (std::size_t s = 0; s < scene.surfaces().size(); ++s) {
    const Mesh& mesh = scene.surfaces()[s].mesh;
    const auto& normals = scene.vertex_normals_of(static_cast<int>(s));
    Places places(mesh, normals);
    auto& list = places.list();
    tbb::parallel_for(std::size_t{0}, list.size(), [&](std::size_t i) {
      list[i].light = gathered(scene, lighting, list[i].position, list[i].normal);
    });
    per_vertex_.emplace_back(mesh.vertices.size(), Vector3f::Zero());
    tbb::parallel_for(std::size_t{0}, mesh.vertices.size(), [&](std::size_t i) {
      per_vertex_[s][i] = places.light_at(mesh.vertices[i].cast<float>(), normals[i]);
    });
  }
}

Vector3f IndirectLight::irradiance(const RayScene& scene, const RayPacket& rays, const HitPacket& hits,
                                   int lane) const {
  const int surface = hits.surface[lane];
  const Vector3i& triangle = scene.surfaces()[surface].mesh.triangles[hits.triangle[lane]];
  const auto& values = per_vertex_[surface];
  const float u = hits.u[lane], v = hits.v[lane];
  const Vector3f value = (1 - u - v) * values[triangle[0]] + u * values[triangle[1]] + v * values[triangle[2]];
  const bool behind = hits.geometric_normal(lane).dot(rays.direction(lane)) > 0;
  return behind ? Vector3f(0.5f * value) : value;
}

}  // namespace dressform
