#include <cmath>
#include <limits>

#include "scenes/error.h"
#include "scenes/formats/file_mesh.h"
#include "scenes/formats/ply.h"

namespace dressform {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

const PlyProperty& scalar(const std::string& where, const PlyElement& element, const std::string& name) {
  const PlyProperty* property = element.find(name);
  if (!property || !property->starts.empty())
    throw InputError(where, "found no \"" + name + "\" of element \"" + element.name + "\"; expected one");
  return *property;
}

std::vector<Vector3d> read_vertices(const std::string& where, const PlyElement& element) {
  const PlyProperty* axes[3] = {&scalar(where, element, "x"), &scalar(where, element, "y"),
                                &scalar(where, element, "z")};
  std::vector<Vector3d> vertices(element.count);
  for (std::size_t i = 0; i < element.count; ++i)
    for (int k = 0; k < 3; ++k) vertices[i][k] = axes[k]->values[i];
  return vertices;
}

// Texture coordinates of vertices, v down, under any of the names in use; empty when there are none.
std::vector<Vector2f> read_vertex_uv(const PlyElement& element) {
  const char* names[][2] = {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texcoord_u", "texcoord_v"}};
  for (const auto& name : names) {
    const PlyProperty *u = element.find(name[0]), *v = element.find(name[1]);
    if (!u || !v || !u->starts.empty() || !v->starts.empty()) continue;
    std::vector<Vector2f> uv(element.count);
    for (std::size_t i = 0; i < element.count; ++i)
      uv[i] = {static_cast<float>(u->values[i]), static_cast<float>(1 - v->values[i])};
    return uv;
  }
  return {};
}

// Texture coordinates of the corners of one polygon, v down.
std::vector<Vector2f> polygon_uv(const PlyProperty* texcoord, std::size_t face, const std::vector<Vector2f>& vertex_uv,
                                 const std::vector<int>& polygon) {
  std::vector<Vector2f> uv(polygon.size(), Vector2f(kNone, kNone));
  if (texcoord) {
    const std::size_t start = texcoord->starts[face], size = texcoord->starts[face + 1] - start;
    for (std::size_t k = 0; size == 2 * polygon.size() && k < polygon.size(); ++k)
      uv[k] = {static_cast<float>(texcoord->values[start + 2 * k]),
               static_cast<float>(1 - texcoord->values[start + 2 * k + 1])};
  } else {
    for (std::size_t k = 0; k < polygon.size(); ++k) uv[k] = vertex_uv[polygon[k]];
  }
  return uv;
}

std::vector<int> polygon_of(const std::string& where, const PlyProperty& indices, std::size_t face,
                            std::size_t vertices) {
  const std::size_t start = indices.starts[face], end = indices.starts[face + 1];
  if (end - start < 3) throw InputError(where, "face " + std::to_string(face) + " has fewer than three corners");
  std::vector<int> polygon;
  for (std::size_t k = start; k < end; ++k) {
    const double index = indices.values[k];
    if (!(index >= 0 && index < static_cast<double>(vertices)))
      throw InputError(where, "face " + std::to_string(face) + " names a vertex out of range; expected 0 to " +
                                  std::to_string(vertices) + " - 1");
    polygon.push_back(static_cast<int>(index));
  }
  return polygon;
}

void read_faces(const std::string& where, const PlyElement& faces, const std::vector<Vector2f>& vertex_uv,
                FileMesh& result) {
  const PlyProperty* indices = faces.find("vertex_indices");
  if (!indices) indices = faces.find("vertex_index");
  if (!indices || indices->starts.empty())
    throw InputError(where, "found faces without a list of vertex indices; expected vertex_indices");
  const PlyProperty* texcoord = faces.find("texcoord");
  if (texcoord && texcoord->starts.empty()) texcoord = nullptr;
  for (std::size_t f = 0; f < faces.count; ++f) {
    const auto polygon = polygon_of(where, *indices, f, result.mesh.vertices.size());
    const bool textured = texcoord || !vertex_uv.empty();
    const auto uv = textured ? polygon_uv(texcoord, f, vertex_uv, polygon) : std::vector<Vector2f>{};
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      result.mesh.triangles.emplace_back(polygon[0], polygon[k - 1], polygon[k]);
      if (textured) result.corner_uv.push_back({uv[0], uv[k - 1], uv[k]});
    }
  }
}

}  // namespace

FileMesh read_ply_mesh(const std::filesystem::path& path) {
  const std::string where = path.string();
  const PlyFile file = read_ply_file(path);
  const PlyElement *vertices = file.find("vertex"), *faces = file.find("face");
  if (!vertices) throw InputError(where, "found no vertices; expected the element \"vertex\"");
  if (!faces) throw InputError(where, "found no faces; expected the element \"face\"");
  FileMesh result;
  result.mesh.vertices = read_vertices(where, *vertices);
  const std::vector<Vector2f> vertex_uv = read_vertex_uv(*vertices);
  result.may_be_split = !vertex_uv.empty();
  read_faces(where, *faces, vertex_uv, result);
  for (const auto& comment : file.comments)
    if (comment.rfind("TextureFile ", 0) == 0) result.images.push_back(path.parent_path() / comment.substr(12));
  return result;
}

}  // namespace dressform
