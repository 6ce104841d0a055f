#include <cmath>
#include <limits>

#include "scenes/error.h"
#include "scenes/formats/file_mesh.h"
#include "scenes/formats/mtl.h"
#include "scenes/formats/ply.h"
#include "scenes/formats/polygon.h"

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

// RGB 0-1 of vertices, of bytes or of fractions; empty when there are none.
std::vector<Vector3f> read_vertex_colors(const PlyElement& element) {
  const char* names[][3] = {
      {"red", "green", "blue"}, {"r", "g", "b"}, {"diffuse_red", "diffuse_green", "diffuse_blue"}};
  for (const auto& name : names) {
    const PlyProperty* rgb[3] = {element.find(name[0]), element.find(name[1]), element.find(name[2])};
    if (!rgb[0] || !rgb[1] || !rgb[2]) continue;
    std::vector<Vector3f> colors(element.count);
    for (int k = 0; k < 3; ++k) {
      if (!rgb[k]->starts.empty()) return {};
      for (std::size_t i = 0; i < element.count; ++i)
        colors[i][k] = static_cast<float>(rgb[k]->values[i] / rgb[k]->full_scale);
    }
    return colors;
  }
  return {};
}

// Reads the faces, polygon by polygon.
class Faces {
 public:
  Faces(const std::string& where, const PlyElement& faces, const PlyElement& vertices, Wanted wanted, FileMesh& result)
      : where_(where), faces_(faces), result_(result), vertex_uv_(read_vertex_uv(vertices)) {
    indices_ = faces.find("vertex_indices");
    if (!indices_) indices_ = faces.find("vertex_index");
    if (!indices_ || indices_->starts.empty())
      throw InputError(where, "found faces without a list of vertex indices; expected vertex_indices");
    result.may_be_split = !vertex_uv_.empty();
    if (wanted == Wanted::shape) {
      vertex_uv_.clear();
      return;
    }
    texcoord_ = faces.find("texcoord");
    if (texcoord_ && texcoord_->starts.empty()) texcoord_ = nullptr;
    texture_number_ = faces.find("texnumber");
    if (texture_number_ && !texture_number_->starts.empty()) texture_number_ = nullptr;
    vertex_color_ = read_vertex_colors(vertices);
  }

  void read() {
    for (std::size_t f = 0; f < faces_.count; ++f) read_face(f);
  }

 private:
  void read_face(std::size_t face) {
    const auto polygon = polygon_of(where_, *indices_, face, result_.mesh.vertices.size());
    const bool textured = texcoord_ || !vertex_uv_.empty();
    const auto uv = textured ? polygon_uv(texcoord_, face, vertex_uv_, polygon) : std::vector<Vector2f>{};
    part(face, polygon);
    for (const auto& [a, b, c] : triangles_) {
      result_.mesh.triangles.emplace_back(polygon[a], polygon[b], polygon[c]);
      if (textured) result_.corner_uv.push_back({uv[a], uv[b], uv[c]});
      if (!vertex_color_.empty())
        result_.corner_color.push_back(
            {vertex_color_[polygon[a]], vertex_color_[polygon[b]], vertex_color_[polygon[c]]});
      if (!result_.materials.empty()) result_.material.push_back(material_of(face));
    }
  }

  // Fills `triangles_`.
  void part(std::size_t face, const std::vector<int>& polygon) {
    triangles_.clear();
    if (polygon.size() == 3) {
      triangles_.push_back({0, 1, 2});
      return;
    }
    outline_.clear();
    for (int v : polygon) outline_.push_back(result_.mesh.vertices[v]);
    if (!triangulate(outline_, triangles_))
      throw InputError(where_, "face " + std::to_string(face) + " has " + std::to_string(polygon.size()) +
                                   " corners and an outline that crosses itself; expected a plane polygon");
  }

  int material_of(std::size_t face) const {
    if (!texture_number_) return 0;
    const double number = texture_number_->values[face];
    if (!(number >= 0 && number < static_cast<double>(result_.materials.size())))
      throw InputError(where_, "face " + std::to_string(face) +
                                   " has a texnumber without a TextureFile; expected one of " +
                                   std::to_string(result_.materials.size()));
    return static_cast<int>(number);
  }

  const std::string& where_;
  const PlyElement& faces_;
  FileMesh& result_;
  const PlyProperty *indices_ = nullptr, *texcoord_ = nullptr, *texture_number_ = nullptr;
  std::vector<Vector2f> vertex_uv_;
  std::vector<Vector3f> vertex_color_;
  std::vector<Vector3d> outline_;
  std::vector<std::array<int, 3>> triangles_;
};

// One material for each TextureFile comment.
void read_textures(const std::filesystem::path& path, const PlyFile& file, FileMesh& result) {
  for (const auto& comment : file.comments) {
    if (comment.rfind("TextureFile ", 0) != 0) continue;
    FileMaterial material;
    material.name = std::string(trimmed(std::string_view(comment).substr(12)));
    material.image = static_cast<int>(result.images.size());
    material.transparency = Transparency::holes;
    result.images.push_back({beside(path, material.name), {}});
    result.materials.push_back(material);
  }
}

}  // namespace

FileMesh read_ply_mesh(const std::filesystem::path& path, Wanted wanted) {
  const std::string where = path.string();
  const PlyFile file = read_ply_file(path);
  const PlyElement *vertices = file.find("vertex"), *faces = file.find("face");
  if (!vertices) throw InputError(where, "found no vertices; expected the element \"vertex\"");
  if (!faces)
    throw InputError(where, file.find("tristrips") ? "found triangle strips (tristrips); expected the element \"face\""
                                                   : "found no faces; expected the element \"face\"");
  FileMesh result;
  result.mesh.vertices = read_vertices(where, *vertices);
  if (wanted == Wanted::look) read_textures(path, file, result);
  Faces(where, *faces, *vertices, wanted, result).read();
  return result;
}

}  // namespace dressform
