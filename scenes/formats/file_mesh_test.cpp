#include "scenes/formats/file_mesh.h"

#include <gtest/gtest.h>

namespace dressform {
namespace {

TEST(KeepTriangles, TakesAlongWhatTrianglesCarry) {
  FileMesh file;
  file.mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}, {2, 1, 0}}};
  file.material = {4, 5, 6};
  file.corner_uv.resize(3);
  for (int t = 0; t < 3; ++t) file.corner_uv[t][0].x() = static_cast<float>(t);
  keep_triangles({1, 0, 1}, file);
  EXPECT_EQ(file.mesh.triangles, (std::vector<Vector3i>{{0, 1, 2}, {2, 1, 0}}));
  EXPECT_EQ(file.material, (std::vector<int>{4, 6}));
  ASSERT_EQ(file.corner_uv.size(), 2u);
  EXPECT_EQ(file.corner_uv[1][0].x(), 2);
  EXPECT_TRUE(file.corner_color.empty());
  EXPECT_EQ(file.mesh.vertices.size(), 4u);
  EXPECT_THROW(keep_triangles({1}, file), std::invalid_argument);
}

}  // namespace
}  // namespace dressform
