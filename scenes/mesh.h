#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace dressform {

using Eigen::Vector2f;
using Eigen::Vector3d;
using Eigen::Vector3f;
using Eigen::Vector3i;

// Indexed triangle mesh. Metres; triangles are counter-clockwise seen from outside.
struct Mesh {
  std::vector<Vector3d> vertices;
  std::vector<Vector3i> triangles;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(vertices, triangles);
  }
};

// Mesh with one texture. Texture coordinates belong to triangle corners, so that the vertices stay joined across
// seams. u to the right, v DOWN from the top left corner of the image, both 0 to 1 (glTF's convention; OBJ's v is
// 1 - v). Texture: 8-bit BGR, sRGB.
struct TexturedMesh {
  Mesh mesh;
  std::vector<std::array<Vector2f, 3>> corner_uv;  // one per triangle
  cv::Mat texture;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(mesh, corner_uv, texture);
  }
};

// Points with unit normals (towards the sensor that saw them), colours (RGB 0-1, sRGB) and the view they come from.
// `normals`, `colors` and `views` are empty or as long as `points`.
struct PointCloud {
  std::vector<Vector3d> points;
  std::vector<Vector3d> normals;
  std::vector<Vector3f> colors;
  std::vector<int> views;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(points, normals, colors, views);
  }
};

// Area-weighted unit vertex normals.
std::vector<Vector3d> vertex_normals(const Mesh& mesh);

// Boundary loops (each a list of vertex indices, ordered so that the surface lies to the left of the walk).
// Throws std::invalid_argument when an edge has more than two triangles.
std::vector<std::vector<int>> boundary_loops(const Mesh& mesh);

// Two counts are of connected pieces: `components` of triangles joined by vertices, `loops` of boundary edges (as many
// as boundary_loops finds; where the mesh is not manifold, the connected pieces of its boundary). Number of boundary
// edges, of edges shared by more than two triangles, and the Euler characteristic of a mesh.
struct Topology {
  int vertices = 0, edges = 0, triangles = 0, boundary_edges = 0, non_manifold_edges = 0, components = 0, loops = 0;
  int euler() const { return vertices - edges + triangles; }
  bool closed() const { return boundary_edges == 0 && non_manifold_edges == 0; }
};
Topology topology(const Mesh& mesh);  // vertices: only those used by a triangle

// The same mesh without unused vertices.
Mesh compacted(const Mesh& mesh);

// The mesh moved by a rigid motion.
Mesh transformed(const Mesh& mesh, const Eigen::Matrix4d& target_from_source);

}  // namespace dressform
