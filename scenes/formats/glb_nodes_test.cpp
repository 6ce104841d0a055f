#include "scenes/formats/glb_nodes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dressform {
namespace {

using Eigen::Vector4d;

// Node 0 is one metre to the right of the world, holds node 1, which is twice as large; node 2 stands alone.
tinygltf::Model three_nodes() {
  tinygltf::Model model;
  model.nodes.resize(3);
  model.nodes[0].translation = {1, 0, 0};
  model.nodes[0].children = {1};
  model.nodes[1].scale = {2, 2, 2};
  return model;
}

std::string node_error(const tinygltf::Model& model) {
  try {
    placed_nodes(model, GlbData("a.glb", model));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(GlbNodes, StandWhereTheirParentsPutThem) {
  const tinygltf::Model model = three_nodes();
  const auto placed = placed_nodes(model, GlbData("a.glb", model));
  ASSERT_EQ(placed.size(), 3u);
  ASSERT_TRUE(placed[1]);
  EXPECT_EQ(*placed[1] * Vector4d(1, 1, 1, 1), Vector4d(3, 2, 2, 1));
  ASSERT_TRUE(placed[2]) << "without scenes all are placed";
  EXPECT_EQ(*placed[2], Eigen::Matrix4d::Identity());
}

TEST(GlbNodes, ThoseOfNoSceneAreNotPlaced) {
  tinygltf::Model model = three_nodes();
  model.scenes.resize(1);
  model.scenes[0].nodes = {0};
  const auto placed = placed_nodes(model, GlbData("a.glb", model));
  EXPECT_TRUE(placed[0] && placed[1]);
  EXPECT_FALSE(placed[2]);
}

TEST(GlbNodes, WhatIsNoTreeIsNamed) {
  tinygltf::Model twice = three_nodes();
  twice.nodes[2].children = {1};
  EXPECT_THAT(node_error(twice), testing::HasSubstr("a.glb: node 1 is reached twice"));
  tinygltf::Model nowhere = three_nodes();
  nowhere.nodes[2].children = {7};
  EXPECT_THAT(node_error(nowhere), testing::HasSubstr("names node 7"));
  tinygltf::Model deep;
  deep.nodes.resize(100);
  for (int n = 0; n + 1 < 100; ++n) deep.nodes[static_cast<std::size_t>(n)].children = {n + 1};
  EXPECT_THAT(node_error(deep), testing::HasSubstr("nested more than 64 deep"));
}

}  // namespace
}  // namespace dressform
