#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenes/error.h"
#include "scenes/mesh.h"

namespace dressform {

// What lies outside 0 to 1 of an image: the image again, its border, the image mirrored, or nothing at all.
enum class Wrap { repeat, clamp, mirror, nothing };

// What an image's transparency means: nothing, holes where it is below `cutoff`, or a mix with what lies behind.
enum class Transparency { ignored, holes, blended };

// An image that a mesh file names or holds.
struct FileImage {
  std::filesystem::path file;  // where it should lie; of one inside the mesh file: that file
  std::string bytes;           // PNG or JPEG inside the mesh file; empty: `file` has them
};

// A material as far as cloth needs it.
struct FileMaterial {
  std::string name;
  int image = -1;                    // its colour, of FileMesh::images; -1: plain
  int opacity_image = -1;            // whose alpha (or grey, where it has none) says where the surface is
  Vector3f tint = Vector3f::Ones();  // RGB 0-1 by which the image is multiplied; plain: the colour itself
  bool tint_is_linear = false;       // glTF: linear light; OBJ: values as on the screen
  std::array<Wrap, 2> wrap{Wrap::repeat, Wrap::repeat};  // in u, in v
  Transparency transparency = Transparency::ignored;
  double cutoff = 0.5, opacity = 1;  // opacity: factor of the image's alpha
  std::optional<InputError> fault;   // why it cannot be drawn; thrown when someone wants to see it
};

// A mesh as a file has it, before seams are joined.
struct FileMesh {
  Mesh mesh;
  std::vector<std::array<Vector2f, 3>> corner_uv;  // one per triangle, v DOWN; NaN for a corner that has none; or empty
  std::vector<std::array<Vector3f, 3>> corner_color;  // one per triangle, RGB 0-1, sRGB; or empty
  std::vector<int> material;                          // one per triangle, -1: none; or empty: none
  std::vector<FileMaterial> materials;
  std::vector<FileImage> images;                 // that materials name, each once
  std::vector<std::filesystem::path> libraries;  // further files that were read for the look: an OBJ's mtllib
  bool may_be_split = false;                     // the format repeats a vertex for each texture coordinate it has
};

// Leaves the triangles for which `kept` (one each) is not zero, with all that they carry; vertices stay.
void keep_triangles(const std::vector<char>& kept, FileMesh& file);

// Whether colours, texture coordinates and materials are wanted as well, or the surface alone.
enum class Wanted { shape, look };

// One reader per format. They throw InputError naming the file; indices are checked, coordinates are finite.
FileMesh read_ply_mesh(const std::filesystem::path& path, Wanted wanted);
FileMesh read_obj_mesh(const std::filesystem::path& path, Wanted wanted);
FileMesh read_glb_mesh(const std::filesystem::path& path, Wanted wanted);

// Bounds of what is taken in, before memory is spent on it: many times what a garment or a scanned person has.
constexpr std::size_t kMostMeshBytes = std::size_t{1} << 30;
constexpr std::size_t kMostVertices = 20'000'000;

// Renumbering of the vertices that joins those at the same place along seams: result[old] = new, numbered in the order
// of their first appearance. Only vertices on the boundary of the split mesh are joined, and none at all if joining
// would give an edge more than two triangles.
std::vector<int> joined_seams(const Mesh& split);

// Whether anything in the file says what the surface looks like: an image, a colour, or a fault that hides one.
bool has_look(const FileMesh& file);

// The surface with one texture: the only image as it is, or all used materials (images, tints, plain colours, UDIM
// tiles, colours of vertices) side by side in one, texel by texel. Triangles that lie in a hole of the image are left
// out. `where` names the mesh file. Throws InputError naming the file and the feature that cannot be kept.
TexturedMesh with_one_texture(const std::string& where, FileMesh file);

}  // namespace dressform
