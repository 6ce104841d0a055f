#include "eval/oracle/oracle_frames.h"

#include "scenes/error.h"
#include "scenes/small_solvers.h"

namespace dressform {

Vector3d centroid_of(const Mesh& mesh) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& vertex : mesh.vertices) sum += vertex;
  return mesh.vertices.empty() ? sum : Vector3d(sum / static_cast<double>(mesh.vertices.size()));
}

Isometry3d mean_motion(const std::vector<Isometry3d>& motions, const Vector3d& centre) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Vector3d image = Vector3d::Zero();
  for (const auto& motion : motions) {
    sum += motion.linear();
    image += motion * centre;
  }
  Isometry3d mean = Isometry3d::Identity();
  mean.linear() = nearest_rotation(sum);
  mean.translation() = image / static_cast<double>(motions.size()) - mean.linear() * centre;
  return mean;
}

Isometry3d model_from_world_by_scan(const OracleInput& input) {
  const auto truth = input.truth.scan_world_from_sensor.find("scan_naked");
  if (truth == input.truth.scan_world_from_sensor.end())
    throw InputError("truth", "has no poses of scan_naked; expected them");
  const auto& tracked = input.made.naked.get().model_from_frame;
  std::vector<Isometry3d> motions;
  for (std::size_t i = 0; i < std::min(tracked.size(), truth->second.size()); ++i)
    if (tracked[i].matrix().allFinite()) motions.push_back(tracked[i] * truth->second[i].inverse());
  if (motions.empty()) throw InputError("scan_naked", "has no tracked frame; expected a scan that was followed");
  return mean_motion(motions, centroid_of(input.truth.naked_body));
}

Isometry3d model_from_world_by_gauge(const OracleInput& input) {
  if (input.truth.world_from_sensor.empty()) throw InputError("truth", "has no poses of sensors; expected them");
  const auto& [sensor, world_from_sensor] = *input.truth.world_from_sensor.begin();
  const auto& registration = input.made.registration.get();
  const auto found = registration.model_from_sensor.find(sensor);
  const auto converged = registration.converged.find(sensor);
  if (found == registration.model_from_sensor.end() || converged == registration.converged.end() || !converged->second)
    throw InputError("registration: " + sensor, "was not registered; expected the sensor that joins model and world");
  return found->second * world_from_sensor.inverse();
}

}  // namespace dressform
