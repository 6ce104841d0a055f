#include "synthetic/operator/clicks.h"

#include <algorithm>
#include <cmath>

#include "scenes/random.h"
#include "synthetic/capture/visibility.h"

namespace dressform {

double length_of(const std::vector<Vector3d>& line, bool closed) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return closed ? length + (line.front() - line.back()).norm() : length;
}

std::vector<Vector3d> resampled(const std::vector<Vector3d>& line, bool closed, int count) {
  std::vector<Vector3d> corners = line;
  if (closed) corners.push_back(line.front());
  const double step = length_of(corners, false) / (closed ? count : count - 1);
  std::vector<Vector3d> result{corners.front()};
  double walked = 0;  // up to the corner `i`
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const double piece = (corners[i + 1] - corners[i]).norm();
    while (static_cast<int>(result.size()) < count) {
      const double left = step * static_cast<double>(result.size()) - walked;
      if (left > piece) break;
      result.push_back(corners[i] + (corners[i + 1] - corners[i]) * (piece > 0 ? left / piece : 0));
    }
    walked += piece;
  }
  while (static_cast<int>(result.size()) < count) result.push_back(corners.back());  // rounding took the last step
  return result;
}

std::vector<int> shared_out(int count, const std::vector<double>& lengths, int least) {
  double total = 0;
  for (const double length : lengths) total += length;
  std::vector<int> counts;
  double walked = 0;
  int given = 0;
  for (const double length : lengths) {
    walked += length;
    const int until = static_cast<int>(std::lround(count * walked / std::max(total, 1e-9)));
    counts.push_back(std::max(least, until - given));
    given = until;
  }
  return counts;
}

const Vector3d& nearest(const std::vector<Vector3d>& points, const Vector3d& to) {
  return *std::min_element(points.begin(), points.end(), [&](const Vector3d& a, const Vector3d& b) {
    return (a - to).squaredNorm() < (b - to).squaredNorm();
  });
}

Vector3d RisingAxis::at(double y) const {
  std::size_t i = 1;
  while (i + 1 < corners.size() && corners[i].y() < y) ++i;
  const Vector3d &low = corners[i - 1], &high = corners[i];
  const double t = std::clamp((y - low.y()) / std::max(high.y() - low.y(), 1e-6), 0.0, 1.0);
  const Vector3d point = low + t * (high - low);
  return {point.x(), y, point.z()};
}

const TruthRim* rim_named(const Garment& garment, const std::string& name) {
  for (const auto& rim : garment.rims)
    if (rim.name == name) return &rim;
  return nullptr;
}

PickedPoints in_frame_of(const SensorSpec& sensor, std::vector<Vector3d> points) {
  for (auto& point : points) point = sensor.world_from_sensor.inverse() * point;
  return {sensor.name, std::move(points)};
}

Vector3d clicked(const Vector3d& meant, const Vector3d& direction, double sigma_m, Seed seed, std::uint64_t stream,
                 std::uint64_t index) {
  const auto error = normal4(seed, stream, index);
  const Vector3d right = direction.unitOrthogonal(), up = direction.cross(right).normalized();
  return meant + sigma_m * (error[0] * right + error[1] * up);
}

Onlookers::Onlookers(const RayScene& dressed, const std::vector<SensorSpec>& rig, double click_px, Seed seed)
    : dressed_(dressed), rig_(rig), click_px_(click_px), seed_(seed) {}

std::vector<int> Onlookers::best(const std::vector<Vector3d>& points) const {
  std::vector<int> best(points.size(), -1);
  std::vector<double> distance(points.size(), INFINITY);
  for (std::size_t k = 0; k < rig_.size(); ++k) {
    const auto seen = seen_by(dressed_, points, rig_[k]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double away = (points[i] - rig_[k].world_from_sensor.translation()).norm();
      if (!seen[i] || away >= distance[i]) continue;
      distance[i] = away;
      best[i] = static_cast<int>(k);
    }
  }
  return best;
}

int Onlookers::nearest_sensor(const Vector3d& point) const {
  const auto away = [&](const SensorSpec& sensor) { return (sensor.world_from_sensor.translation() - point).norm(); };
  const auto found =
      std::min_element(rig_.begin(), rig_.end(), [&](const auto& a, const auto& b) { return away(a) < away(b); });
  return static_cast<int>(found - rig_.begin());
}

std::vector<Vector3d> Onlookers::click(const std::vector<Vector3d>& points, const std::vector<int>& seen_by,
                                       const std::string& name) const {
  const std::uint64_t stream = stream_of(("operator/" + name).c_str());
  std::vector<Vector3d> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SensorSpec& sensor = rig_[seen_by[i] >= 0 ? seen_by[i] : nearest_sensor(points[i])];
    const Vector3d sight = points[i] - sensor.world_from_sensor.translation();
    const Camera& camera = sensor.calibration.color ? *sensor.calibration.color : sensor.calibration.ir;
    result.push_back(clicked(points[i], sight.normalized(), click_px_ * sight.norm() / camera.fx, seed_, stream, i));
  }
  return result;
}

const SensorSpec& Onlookers::main_one(const std::vector<int>& seen_by) const {
  std::vector<int> votes(rig_.size(), 0);
  for (const int k : seen_by)
    if (k >= 0) ++votes[k];
  return rig_[static_cast<std::size_t>(std::max_element(votes.begin(), votes.end()) - votes.begin())];
}

RayScene alone(const Mesh& mesh) {
  RaySurface surface;
  surface.mesh = mesh;
  return RayScene({surface});
}

std::optional<Struck> struck(const RayScene& scene, const Vector3d& origin, const Vector3d& direction, double far_m) {
  RayPacket rays;
  rays.set(0, origin.cast<float>(), direction.cast<float>(), 0.0f, static_cast<float>(far_m));
  HitPacket hits;
  scene.intersect(rays, hits, Coherence::incoherent);
  if (hits.surface[0] < 0) return {};
  return Struck{origin + direction * static_cast<double>(hits.t[0]),
                hits.geometric_normal(0).cast<double>().normalized()};
}

}  // namespace dressform
