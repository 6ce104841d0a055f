#include "scenes/mesh.h"

#include <gtest/gtest.h>

#include "scenes/frame.h"

namespace dressform {
namespace {

Mesh cube() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.vertices.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    mesh.triangles.emplace_back(q[0], q[1], q[2]);
    mesh.triangles.emplace_back(q[0], q[2], q[3]);
  }
  return mesh;
}

// Side of a cylinder about y, `n` vertices a ring, outward.
Mesh tube(int n) {
  Mesh mesh;
  for (int ring = 0; ring < 2; ++ring)
    for (int i = 0; i < n; ++i)
      mesh.vertices.emplace_back(std::sin(2 * M_PI * i / n), ring, std::cos(2 * M_PI * i / n));
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    mesh.triangles.emplace_back(i, j, n + j);
    mesh.triangles.emplace_back(i, n + j, n + i);
  }
  return mesh;
}

TEST(Mesh, CubeIsClosedWithEulerTwo) {
  const Topology found = topology(cube());
  EXPECT_TRUE(found.closed());
  EXPECT_EQ(found.vertices, 8);
  EXPECT_EQ(found.edges, 18);
  EXPECT_EQ(found.triangles, 12);
  EXPECT_EQ(found.euler(), 2);
  EXPECT_EQ(found.components, 1);
  EXPECT_EQ(found.loops, 0);
  EXPECT_TRUE(boundary_loops(cube()).empty());
}

TEST(Mesh, TubeHasTwoLoopsWithTheSurfaceToTheLeft) {
  const Mesh mesh = tube(12);
  const Topology found = topology(mesh);
  EXPECT_EQ(found.boundary_edges, 24);
  EXPECT_EQ(found.boundary_edges, 2 * found.vertices - found.triangles - 2 * found.euler());
  EXPECT_EQ(found.euler(), 0);
  EXPECT_EQ(found.loops, 2);
  const auto loops = boundary_loops(mesh);
  ASSERT_EQ(loops.size(), 2u);
  const auto normals = vertex_normals(mesh);
  for (const auto& loop : loops) {
    ASSERT_EQ(loop.size(), 12u);
    const Vector3d walk = mesh.vertices[loop[1]] - mesh.vertices[loop[0]];
    const Vector3d left = normals[loop[0]].cross(walk);
    const double inward = mesh.vertices[loop[0]].y() < 0.5 ? 1 : -1;  // where the surface lies
    EXPECT_GT(left.y() * inward, 0);
  }
}

TEST(Mesh, LoopsThatTouchInOneVertexStayApart) {
  Mesh mesh;  // two triangles joined in vertex 0 only
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  const auto loops = boundary_loops(mesh);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(loops[0].size(), 3u);
  EXPECT_EQ(topology(mesh).components, 1);
}

TEST(Mesh, EdgeOfThreeTrianglesIsRefused) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  EXPECT_THROW(boundary_loops(mesh), std::invalid_argument);
  EXPECT_EQ(topology(mesh).non_manifold_edges, 1);
  EXPECT_FALSE(topology(mesh).closed());
}

TEST(Mesh, EmptyMesh) {
  EXPECT_TRUE(boundary_loops({}).empty());
  EXPECT_EQ(topology({}).components, 0);
  EXPECT_TRUE(vertex_normals({}).empty());
}

TEST(Mesh, CompactedDropsUnusedVerticesOnly) {
  Mesh mesh = cube();
  mesh.vertices.insert(mesh.vertices.begin(), Vector3d(9, 9, 9));
  for (auto& t : mesh.triangles) t += Vector3i::Ones();
  EXPECT_EQ(topology(mesh).vertices, 8);
  const Mesh result = compacted(mesh);
  EXPECT_EQ(result.vertices, cube().vertices);
  EXPECT_EQ(result.triangles, cube().triangles);
}

TEST(Mesh, NormalsPointOutOfACubeAndTurnWithIt) {
  Mesh mesh = cube();
  for (auto& v : mesh.vertices) v -= Vector3d::Constant(0.5);
  const auto normals = vertex_normals(mesh);
  for (int v = 0; v < 8; ++v) {
    EXPECT_NEAR(normals[v].norm(), 1, 1e-12);
    EXPECT_GT(normals[v].dot(mesh.vertices[v].normalized()), 0.8);
  }
  Eigen::Isometry3d motion = Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized());
  const Mesh moved = transformed(mesh, motion.matrix());
  for (int v = 0; v < 8; ++v) {
    EXPECT_LT((moved.vertices[v] - motion * mesh.vertices[v]).norm(), 1e-12);
    EXPECT_LT((vertex_normals(moved)[v] - motion.rotation() * normals[v]).norm(), 1e-12);
  }
}

TEST(Frame, TwentyFiveJointNames) {
  EXPECT_EQ(joint_names().size(), 25u);
  EXPECT_EQ(joint_names()[0], "SpineBase");
  EXPECT_EQ(joint_names()[20], "SpineShoulder");
  EXPECT_EQ(joint_names()[24], "ThumbRight");
}

}  // namespace
}  // namespace dressform
