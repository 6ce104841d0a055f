#include "scenes/mesh_io.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "scenes/error.h"
#include "scenes/file_bytes.h"
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

FileMesh read_by_extension(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension == ".ply") return read_ply_mesh(path);
  if (extension == ".obj") return read_obj_mesh(path);
  if (extension == ".glb") return read_glb_mesh(path);
  throw InputError(path.string(), "found the extension \"" + extension + "\"; expected .obj, .ply or .glb");
}

// Seams joined, triangles that name a vertex twice left out.
FileMesh joined(const FileMesh& file) {
  FileMesh result = file;
  std::vector<int> new_from_old;
  if (file.may_be_split) {
    new_from_old = joined_seams(file.mesh);
    result.mesh.vertices.resize(
        file.mesh.vertices.empty() ? 0 : 1 + *std::max_element(new_from_old.begin(), new_from_old.end()));
    for (std::size_t v = 0; v < new_from_old.size(); ++v) result.mesh.vertices[new_from_old[v]] = file.mesh.vertices[v];
  }
  result.mesh.triangles.clear();
  result.corner_uv.clear();
  for (std::size_t i = 0; i < file.mesh.triangles.size(); ++i) {
    Vector3i t = file.mesh.triangles[i];
    if (file.may_be_split) t = {new_from_old[t[0]], new_from_old[t[1]], new_from_old[t[2]]};
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    result.mesh.triangles.push_back(t);
    if (!file.corner_uv.empty()) result.corner_uv.push_back(file.corner_uv[i]);
  }
  return result;
}

FileMesh read_checked(const std::filesystem::path& path) {
  const FileMesh file = read_by_extension(path);
  for (std::size_t v = 0; v < file.mesh.vertices.size(); ++v)
    if (!file.mesh.vertices[v].allFinite())
      throw InputError(path.string(), "vertex " + std::to_string(v) + " has a coordinate that is not finite");
  FileMesh result = joined(file);
  if (result.mesh.triangles.empty()) throw InputError(path.string(), "found no triangle; expected at least one");
  return result;
}

cv::Mat decode(const std::string& where, const std::string& bytes) {
  cv::Mat image;
  if (!bytes.empty()) {
    const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    image = cv::imdecode(raw, cv::IMREAD_COLOR);
  }
  if (image.empty()) throw InputError(where, "not a readable image; expected a PNG or JPEG");
  return image;
}

cv::Mat read_texture(const std::filesystem::path& path, const FileMesh& file, const std::filesystem::path& texture) {
  if (!texture.empty()) return decode(texture.string(), read_file_bytes(texture));
  const std::size_t count = file.images.size() + file.embedded_images.size();
  if (count == 0 && !file.missing_material_file.empty())
    throw InputError((path.parent_path() / file.missing_material_file).string(),
                     "found no such file; " + path.string() + " names it");
  if (count != 1) throw InputError(path.string(), "names " + std::to_string(count) + " images; expected one texture");
  if (!file.embedded_images.empty()) return decode(path.string() + " (image inside)", file.embedded_images[0]);
  return decode(file.images[0].string(), read_file_bytes(file.images[0]));
}

// Whole repeats of the image are taken off, triangle by triangle: what is left starts in [0, 1].
std::array<Vector2f, 3> unrepeated(std::array<Vector2f, 3> uv) {
  constexpr float kTolerance = 1e-4f;  // rounding at the image's edge is no repeat
  for (int k = 0; k < 2; ++k) {
    const auto [low, high] = std::minmax({uv[0][k], uv[1][k], uv[2][k]});
    if (low >= -kTolerance && high <= 1 + kTolerance) continue;
    const float shift = std::floor(low + kTolerance);
    for (auto& corner : uv) corner[k] -= shift;
  }
  return uv;
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& path) { return read_checked(path).mesh; }

TexturedMesh read_textured_mesh(const std::filesystem::path& path, const std::filesystem::path& texture) {
  const FileMesh file = read_checked(path);
  if (file.corner_uv.empty())
    throw InputError(path.string(), "found no texture coordinates; expected them at every corner");
  TexturedMesh result;
  result.mesh = file.mesh;
  for (std::size_t i = 0; i < file.corner_uv.size(); ++i) {
    for (const auto& uv : file.corner_uv[i])
      if (!uv.allFinite())
        throw InputError(path.string(), "triangle " + std::to_string(i) + " has a corner without texture coordinates");
    result.corner_uv.push_back(unrepeated(file.corner_uv[i]));
  }
  result.texture = read_texture(path, file, texture);
  return result;
}

std::vector<std::uint8_t> read_ply_vertex_property(const std::filesystem::path& path, const std::string& name) {
  const PlyFile file = read_ply_file(path);
  const PlyElement* vertices = file.find("vertex");
  const PlyProperty* property = vertices ? vertices->find(name) : nullptr;
  if (!property || !property->starts.empty())
    throw InputError(path.string(), "found no vertex property \"" + name + "\"; expected one of type uchar");
  std::vector<std::uint8_t> result;
  for (double value : property->values) {
    if (!(value >= 0 && value <= 255) || value != std::floor(value))
      throw InputError(path.string(), "vertex property \"" + name + "\" has a value that is no uchar");
    result.push_back(static_cast<std::uint8_t>(value));
  }
  if (!file.find("face")) return result;
  const FileMesh mesh = read_ply_mesh(path);
  if (!mesh.may_be_split) return result;
  const std::vector<int> new_from_old = joined_seams(mesh.mesh);  // as read_mesh numbers them
  std::vector<std::uint8_t> joined_values;
  for (std::size_t v = 0; v < result.size(); ++v)
    if (new_from_old[v] == static_cast<int>(joined_values.size())) joined_values.push_back(result[v]);
  return joined_values;
}

}  // namespace dressform
