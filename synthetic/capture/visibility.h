#pragma once
#include <cstdint>
#include <vector>

#include "scenes/ground_truth.h"
#include "scenes/scene.h"
#include "synthetic/capture/ray_scene.h"

namespace dressform {

// For each point, whether the IR camera of the sensor sees it: inside the image, nothing in between.
std::vector<std::uint8_t> seen_by(const RayScene& scene, const std::vector<Vector3d>& points, const SensorSpec& sensor);

// Per vertex of an open surface in the scene: how many IR cameras of the rig see its outer side: inside the image,
// facing, nothing in between.
std::vector<std::uint8_t> count_views(const RayScene& scene, const Mesh& mesh, const std::vector<SensorSpec>& rig);

// Part of a closed line's length that at least one IR camera sees, from either side of the cloth.
double visible_part(const RayScene& scene, const std::vector<Vector3d>& points, const std::vector<SensorSpec>& rig);

}  // namespace dressform
