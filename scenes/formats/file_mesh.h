#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// A mesh as a file has it, before seams are joined.
struct FileMesh {
  Mesh mesh;
  std::vector<std::array<Vector2f, 3>> corner_uv;  // one per triangle, v DOWN; NaN for a corner that has none; or empty
  std::vector<std::filesystem::path> images;       // that the file names, each once, where they should lie
  std::vector<std::string> embedded_images;        // PNG or JPEG bytes inside the file
  std::string missing_material_file;               // an OBJ's mtllib that is not there
  bool may_be_split = false;                       // the format repeats a vertex for each texture coordinate it has
};

// One reader per format. They throw InputError naming the file; indices are checked, coordinates are finite.
FileMesh read_ply_mesh(const std::filesystem::path& path);
FileMesh read_obj_mesh(const std::filesystem::path& path);
FileMesh read_glb_mesh(const std::filesystem::path& path);

// Renumbering of the vertices that joins those at the same place along seams: result[old] = new, numbered in the order
// of their first appearance. Only vertices on the boundary of the split mesh are joined, and none at all if joining
// would give an edge more than two triangles.
std::vector<int> joined_seams(const Mesh& split);

}  // namespace dressform
