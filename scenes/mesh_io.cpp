#include "scenes/mesh_io.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "scenes/error.h"
#include "scenes/formats/file_mesh.h"
#include "scenes/formats/ply.h"

namespace dressform {
namespace {

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

FileMesh read_by_extension(const std::filesystem::path& path, Wanted wanted) {
  const std::string extension = extension_of(path);
  if (extension == ".ply") return read_ply_mesh(path, wanted);
  if (extension == ".obj") return read_obj_mesh(path, wanted);
  if (extension == ".glb") return read_glb_mesh(path, wanted);
  throw InputError(path.string(), "found the extension \"" + extension + "\"; expected .obj, .ply or .glb");
}

// Seams joined, triangles that name a vertex twice left out.
void join(FileMesh& file) {
  if (file.may_be_split && !file.mesh.vertices.empty()) {
    const std::vector<int> new_from_old = joined_seams(file.mesh);
    std::vector<Vector3d> vertices(
        1 + static_cast<std::size_t>(*std::max_element(new_from_old.begin(), new_from_old.end())));
    for (std::size_t v = 0; v < new_from_old.size(); ++v) vertices[new_from_old[v]] = file.mesh.vertices[v];
    file.mesh.vertices = std::move(vertices);
    for (Vector3i& t : file.mesh.triangles) t = {new_from_old[t[0]], new_from_old[t[1]], new_from_old[t[2]]};
  }
  std::vector<char> kept;
  kept.reserve(file.mesh.triangles.size());
  for (const Vector3i& t : file.mesh.triangles) kept.push_back(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
  keep_triangles(kept, file);
}

FileMesh read_checked(const std::filesystem::path& path, Wanted wanted) {
  FileMesh file = read_by_extension(path, wanted);
  for (std::size_t v = 0; v < file.mesh.vertices.size(); ++v)
    if (!file.mesh.vertices[v].allFinite())
      throw InputError(path.string(), "vertex " + std::to_string(v) + " has a coordinate that is not finite");
  join(file);
  if (file.mesh.triangles.empty()) throw InputError(path.string(), "found no triangle; expected at least one");
  return file;
}

// Every triangle shows this image, whatever the file says.
void override_materials(const std::filesystem::path& texture, FileMesh& file) {
  FileMaterial material;
  material.name = texture.string();
  material.image = 0;
  material.transparency = Transparency::holes;
  file.materials = {material};
  file.images = {{texture, {}}};
  file.material.assign(file.mesh.triangles.size(), 0);
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& path) { return read_checked(path, Wanted::shape).mesh; }

TexturedMesh read_textured_mesh(const std::filesystem::path& path, const std::filesystem::path& texture) {
  FileMesh file = read_checked(path, Wanted::look);
  if (!texture.empty()) override_materials(texture, file);
  return with_one_texture(path.string(), std::move(file));
}

TexturedMesh read_mesh_as_it_looks(const std::filesystem::path& path) {
  FileMesh file = read_checked(path, Wanted::look);
  if (!has_look(file)) return {std::move(file.mesh), {}, {}};
  return with_one_texture(path.string(), std::move(file));
}

std::vector<std::filesystem::path> mesh_files(const std::filesystem::path& path) {
  const FileMesh file = read_by_extension(path, Wanted::look);
  std::vector<std::filesystem::path> files{path};
  files.insert(files.end(), file.libraries.begin(), file.libraries.end());
  std::error_code error;
  for (const auto& image : file.images)
    if (image.bytes.empty() && std::filesystem::is_regular_file(image.file, error)) files.push_back(image.file);
  return files;
}

std::vector<std::uint8_t> read_ply_vertex_property(const std::filesystem::path& path, const std::string& name) {
  const auto values = find_ply_vertex_property(path, name);
  if (!values) throw InputError(path.string(), "found no vertex property \"" + name + "\"; expected one of type uchar");
  return *values;
}

std::optional<std::vector<std::uint8_t>> find_ply_vertex_property(const std::filesystem::path& path,
                                                                  const std::string& name) {
  const PlyFile file = read_ply_file(path);
  const PlyElement* vertices = file.find("vertex");
  const PlyProperty* property = vertices ? vertices->find(name) : nullptr;
  if (!property || !property->starts.empty()) return {};
  std::vector<std::uint8_t> result;
  for (double value : property->values) {
    if (!(value >= 0 && value <= 255) || value != std::floor(value))
      throw InputError(path.string(), "vertex property \"" + name + "\" has a value that is no uchar");
    result.push_back(static_cast<std::uint8_t>(value));
  }
  if (!file.find("face")) return result;
  const FileMesh mesh = read_ply_mesh(path, Wanted::shape);
  if (!mesh.may_be_split) return result;
  const std::vector<int> new_from_old = joined_seams(mesh.mesh);  // as read_mesh numbers them
  std::vector<std::uint8_t> joined_values;
  for (std::size_t v = 0; v < result.size(); ++v)
    if (new_from_old[v] == static_cast<int>(joined_values.size())) joined_values.push_back(result[v]);
  return joined_values;
}

}  // namespace dressform
