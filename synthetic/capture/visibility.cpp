#include "synthetic/capture/visibility.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace dressform {
namespace {

constexpr float clearance_m = 0.003f;  // what lies nearer to the point than this is the point's own surface
constexpr float near_m = 0.2f;

bool in_image(const SensorSpec& sensor, const Vector3d& point) {
  const Vector3d in_camera = sensor.world_from_sensor.inverse() * point;
  return in_camera.z() > 0.1 && sensor.calibration.ir.contains(sensor.calibration.ir.project(in_camera));
}

// Clear lines of sight from one sensor to up to sixteen points.
void trace_sight(const RayScene& scene, const Vector3d& eye, const Vector3d* points, int count,
                 bool (&clear)[packet_size]) {
  RayPacket rays;
  for (int lane = 0; lane < count; ++lane) {
    const Vector3f direction = (points[lane] - eye).cast<float>();
    const float length = direction.norm();
    rays.set(lane, eye.cast<float>(), direction / length, near_m, length - clearance_m);
  }
  bool hidden[packet_size];
  scene.occluded(rays, hidden, Coherence::incoherent);
  for (int lane = 0; lane < packet_size; ++lane) clear[lane] = lane < count && !hidden[lane];
}

}  // namespace

std::vector<std::uint8_t> seen_by(const RayScene& scene, const std::vector<Vector3d>& points,
                                  const SensorSpec& sensor) {
  std::vector<std::uint8_t> seen(points.size(), 0);
  const std::size_t packets = (points.size() + packet_size - 1) / packet_size;
  tbb::parallel_for(std::size_t{0}, packets, [&](std::size_t packet) {
    const std::size_t first = packet * packet_size;
    const int count = static_cast<int>(std::min<std::size_t>(packet_size, points.size() - first));
    bool clear[packet_size];
    trace_sight(scene, sensor.world_from_sensor.translation(), &points[first], count, clear);
    for (int lane = 0; lane < count; ++lane) seen[first + lane] = clear[lane] && in_image(sensor, points[first + lane]);
  });
  return seen;
}

std::vector<std::uint8_t> count_views(const RayScene& scene, const Mesh& mesh, const std::vector<SensorSpec>& rig) {
  const std::vector<Vector3d> normals = vertex_normals(mesh);
  std::vector<std::uint8_t> views(mesh.vertices.size(), 0);
  for (const auto& sensor : rig) {
    const auto seen = seen_by(scene, mesh.vertices, sensor);
    const Vector3d eye = sensor.world_from_sensor.translation();
    for (std::size_t i = 0; i < views.size(); ++i) views[i] += seen[i] && normals[i].dot(eye - mesh.vertices[i]) > 0;
  }
  return views;
}

double visible_part(const RayScene& scene, const std::vector<Vector3d>& points, const std::vector<SensorSpec>& rig) {
  constexpr double step_m = 0.003;
  std::vector<Vector3d> middles;
  std::vector<double> lengths;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d &from = points[i], &to = points[(i + 1) % points.size()];
    const int pieces = std::max(1, static_cast<int>((to - from).norm() / step_m));
    for (int k = 0; k < pieces; ++k) {
      middles.push_back(from + (to - from) * ((k + 0.5) / pieces));
      lengths.push_back((to - from).norm() / pieces);
    }
  }
  std::vector<std::uint8_t> any(middles.size(), 0);
  for (const auto& sensor : rig) {
    const auto seen = seen_by(scene, middles, sensor);
    for (std::size_t i = 0; i < any.size(); ++i) any[i] |= seen[i];
  }
  double total = 0, visible = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    total += lengths[i];
    if (any[i]) visible += lengths[i];
  }
  return total > 0 ? visible / total : 0;
}

}  // namespace dressform
