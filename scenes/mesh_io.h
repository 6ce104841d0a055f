#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// Reads OBJ, PLY (ASCII and binary) or GLB by its extension; coincident vertices that differ only in texture
// coordinates are joined. Throws InputError naming the file: missing, unreadable, no triangle, an index out of range,
// a coordinate that is not finite.
Mesh read_mesh(const std::filesystem::path& path);

// The same with what it looks like, as one texture: a single image as it is; several materials, images and plain
// colours (OBJ's Kd, glTF's baseColorFactor), repeats, UDIM tiles and colours of vertices side by side in a texture
// made for them. Triangles that lie in a hole of the image are left out. `texture` names a PNG or JPEG and overrides
// what the file says. Throws InputError naming file and feature where the file says nothing of its look, an image or a
// material library cannot be found, or something cannot be kept (translucent cloth, a packed texture, a required
// extension).
TexturedMesh read_textured_mesh(const std::filesystem::path& path, const std::filesystem::path& texture = {});

// The same where the file says what it looks like; the mesh alone (no texture) where it says nothing.
TexturedMesh read_mesh_as_it_looks(const std::filesystem::path& path);

// All files that read_textured_mesh(path) reads: the mesh, its material libraries and images, where they are there.
std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& path);

// What a PLY may carry beside vertices and triangles; empty members are left out.
struct PlyExtras {
  std::vector<Vector3d> normals;
  std::vector<Vector3f> colors;                                        // RGB 0-1, written as uchar
  std::map<std::string, std::vector<std::uint8_t>> vertex_properties;  // e.g. "views"
  std::vector<std::array<Vector2f, 3>> corner_uv;  // written as face `texcoord` lists, v UP (MeshLab)
  std::string texture_file;                        // comment TextureFile
};

// Binary little-endian PLY, vertices as double. Written to a temporary name, then renamed.
void write_ply(const std::filesystem::path& path, const Mesh& mesh, const PlyExtras& extras = {});
void write_ply(const std::filesystem::path& path, const PointCloud& cloud);

// A uchar vertex property of a PLY file, e.g. "views". Throws InputError when it is not there.
std::vector<std::uint8_t> read_ply_vertex_property(const std::filesystem::path& path, const std::string& name);
// The same; absent when it is not there.
std::optional<std::vector<std::uint8_t>> find_ply_vertex_property(const std::filesystem::path& path,
                                                                  const std::string& name);

// glTF 2.0 binary with the texture inside (PNG), vertices split where the texture coordinates differ.
void write_glb(const std::filesystem::path& path, const TexturedMesh& mesh);

// OBJ + MTL + PNG beside one another, for other people's tools.
void write_obj(const std::filesystem::path& path, const TexturedMesh& mesh);

}  // namespace dressform
