#include "scenes/formats/glb_nodes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

#include "scenes/mesh.h"

namespace dressform {
namespace {

using Eigen::Matrix4d;

constexpr int kDeepest = 64;  // nodes within nodes; rigs of whole figures have about twenty

Matrix4d local_transform(const tinygltf::Node& node) {
  if (node.matrix.size() == 16) return Eigen::Map<const Matrix4d>(node.matrix.data());  // both column-major
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  if (node.translation.size() == 3) motion.translate(Eigen::Map<const Vector3d>(node.translation.data()));
  if (node.rotation.size() == 4) {
    const auto& q = node.rotation;  // x, y, z, w
    motion.rotate(Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized());
  }
  if (node.scale.size() == 3) motion.scale(Eigen::Map<const Vector3d>(node.scale.data()));
  return motion.matrix();
}

std::vector<int> roots_of(const tinygltf::Model& model, const GlbData& data) {
  if (!model.scenes.empty()) return data.at(model.scenes, std::max(0, model.defaultScene), "scene").nodes;
  std::vector<char> is_child(model.nodes.size(), 0);
  for (const auto& node : model.nodes)
    for (int child : node.children)
      if (child >= 0 && child < static_cast<int>(is_child.size())) is_child[child] = 1;
  std::vector<int> roots;
  for (int n = 0; n < static_cast<int>(is_child.size()); ++n)
    if (!is_child[n]) roots.push_back(n);
  return roots;
}

struct Placer {
  const tinygltf::Model& model;
  const GlbData& data;
  std::vector<std::optional<Matrix4d>> world_from_node;

  void place(int index, const Matrix4d& world_from_parent, int depth) {
    const tinygltf::Node& node = data.at(model.nodes, index, "node");
    if (world_from_node[index])
      data.fail("node " + std::to_string(index) + " is reached twice; expected a tree of nodes");
    if (depth > kDeepest) data.fail("the nodes are nested more than " + std::to_string(kDeepest) + " deep");
    world_from_node[index] = world_from_parent * local_transform(node);
    for (int child : node.children) place(child, *world_from_node[index], depth + 1);
  }
};

}  // namespace

std::vector<std::optional<Matrix4d>> placed_nodes(const tinygltf::Model& model, const GlbData& data) {
  Placer placer{model, data, std::vector<std::optional<Matrix4d>>(model.nodes.size())};
  for (int node : roots_of(model, data)) placer.place(node, Matrix4d::Identity(), 0);
  return placer.world_from_node;
}

}  // namespace dressform
