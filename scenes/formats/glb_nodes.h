#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "scenes/formats/glb_data.h"

namespace dressform {

// World from node of every node of a GLB's scene, by number; nothing for nodes that are in no scene (of files without
// scenes all are placed). Throws InputError by `data` for nodes that are reached twice, nested too deep or not there.
std::vector<std::optional<Eigen::Matrix4d>> placed_nodes(const tinygltf::Model& model, const GlbData& data);

}  // namespace dressform
