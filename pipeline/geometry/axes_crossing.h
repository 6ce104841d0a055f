#pragma once
#include <optional>
#include <vector>

#include "scenes/camera.h"

namespace dressform {

// The point nearest to the optical axes of all sensors (least squares of the distances), metres, world frame: where the
// mannequin of a rig stands. Empty for fewer than two axes, and where they are all but parallel.
std::optional<Vector3d> axes_crossing(const std::vector<Isometry3d>& world_from_sensor);

}  // namespace dressform
