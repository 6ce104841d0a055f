#pragma once
#include <vector>

#include "scenes/camera.h"
#include "scenes/mesh.h"

namespace dressform::metrics {

// Angle of R_estimate R_truth^T by its quaternion, 2 atan2(|q_v|, |q_w|): exact down to zero, where acos has a floor of
// 0.02 degrees.
double rotation_error_deg(const Isometry3d& world_from_sensor_estimate, const Isometry3d& world_from_sensor_truth);

// Distance of the camera centres.
double translation_error_mm(const Isometry3d& world_from_sensor_estimate, const Isometry3d& world_from_sensor_truth);

// Target registration error: root mean square of |T_estimate p - T_truth p| over true points, given in the world, that
// the sensor sees. NaN without points.
double target_registration_error_mm(const Isometry3d& world_from_sensor_estimate,
                                    const Isometry3d& world_from_sensor_truth,
                                    const std::vector<Vector3d>& world_points);

// Those of the points (with the outward normals of their surface) that face the sensor and have a free line of sight.
std::vector<Vector3d> points_seen(const Mesh& world_mesh, const Isometry3d& world_from_sensor, double spacing_m,
                                  std::uint64_t seed);

}  // namespace dressform::metrics
