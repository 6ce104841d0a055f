#include <tiny_obj_loader.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/formats/file_mesh.h"

namespace dressform {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

struct Coordinates {
  std::vector<Vector3d> vertices;
  std::vector<Vector2f> uv;  // v UP, as in the file
};

std::vector<double> numbers_of(const std::string& where, const char* at, const char* end, std::size_t wanted) {
  std::vector<double> numbers;
  while (numbers.size() < wanted) {
    while (at < end && (*at == ' ' || *at == '\t' || *at == '+')) ++at;
    double value = 0;
    const auto [stop, error] = std::from_chars(at, end, value);
    if (error == std::errc::invalid_argument || !std::isfinite(value))
      throw InputError(where, "found \"" + std::string(at, std::min(end, at + 20)) + "\"; expected " +
                                  std::to_string(wanted) + " finite numbers");
    numbers.push_back(value);
    at = stop;
  }
  return numbers;
}

// Vertices and texture coordinates, strictly and in full precision: the OBJ library reads what is no number as 0.
Coordinates read_coordinates(const std::string& path, const std::string& text) {
  Coordinates result;
  std::size_t at = 0;
  for (int line = 1; at < text.size(); ++line) {
    std::size_t end = std::min(text.find('\n', at), text.size());
    const std::size_t next = end + 1;
    if (end > at && text[end - 1] == '\r') --end;
    while (at < end && (text[at] == ' ' || text[at] == '\t')) ++at;
    const std::string where = path + ":" + std::to_string(line);
    const auto is_keyword = [&](const char* word, std::size_t size) {
      return end - at > size && text.compare(at, size, word) == 0 &&
             (text[at + size] == ' ' || text[at + size] == '\t');
    };
    if (is_keyword("v", 1)) {
      const auto xyz = numbers_of(where, text.data() + at + 2, text.data() + end, 3);
      result.vertices.emplace_back(xyz[0], xyz[1], xyz[2]);
    } else if (is_keyword("vt", 2)) {
      const auto uv = numbers_of(where, text.data() + at + 3, text.data() + end, 2);
      result.uv.emplace_back(static_cast<float>(uv[0]), static_cast<float>(uv[1]));
    }
    at = next;
  }
  return result;
}

// Reads material files beside the OBJ, and remembers one that is missing.
class Materials : public tinyobj::MaterialReader {
 public:
  explicit Materials(std::filesystem::path folder) : folder_(std::move(folder)) {}
  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials, std::map<std::string, int>* map,
                  std::string* warn, std::string* err) override {
    std::ifstream file(folder_ / name);
    if (!file) {
      missing = name;
      return true;
    }
    tinyobj::LoadMtl(map, materials, &file, warn, err);
    return true;
  }
  std::string missing;

 private:
  std::filesystem::path folder_;
};

void add_image(const std::filesystem::path& folder, std::string name, FileMesh& result) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const auto path = folder / name;
  if (std::find(result.images.begin(), result.images.end(), path) == result.images.end()) result.images.push_back(path);
}

void add_triangles(const std::string& where, const tinyobj::mesh_t& shape, const Coordinates& coordinates,
                   FileMesh& result) {
  const auto vertex_count = static_cast<int>(coordinates.vertices.size());
  const auto uv_count = static_cast<int>(coordinates.uv.size());
  for (std::size_t i = 0; i + 2 < shape.indices.size(); i += 3) {
    Vector3i triangle;
    std::array<Vector2f, 3> uv;
    for (int k = 0; k < 3; ++k) {
      const auto& corner = shape.indices[i + k];
      if (corner.vertex_index < 0 || corner.vertex_index >= vertex_count || corner.texcoord_index >= uv_count)
        throw InputError(where, "a face names a vertex or texture coordinate that does not exist");
      triangle[k] = corner.vertex_index;
      uv[k] = Vector2f(kNone, kNone);
      if (corner.texcoord_index >= 0) {
        const Vector2f& up = coordinates.uv[corner.texcoord_index];
        uv[k] = {up.x(), 1 - up.y()};
      }
    }
    result.mesh.triangles.push_back(triangle);
    if (uv_count > 0) result.corner_uv.push_back(uv);
  }
}

}  // namespace

FileMesh read_obj_mesh(const std::filesystem::path& path) {
  const std::string where = path.string(), text = read_file_bytes(path);
  const Coordinates coordinates = read_coordinates(where, text);
  Materials reader(path.parent_path());
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warnings, errors;
  std::istringstream stream(text);
  const bool good = tinyobj::LoadObj(&attributes, &shapes, &materials, &warnings, &errors, &stream, &reader, true);
  if (!good || !errors.empty()) throw InputError(where, "not a readable OBJ: " + errors.substr(0, errors.find('\n')));
  for (const char* fault : {"out of bounds", "invalid vertex", "Degenerated face"})
    if (warnings.find(fault) != std::string::npos)
      throw InputError(where,
                       "found a face with fewer than three corners or a corner that does not exist; expected "
                       "corners among the " +
                           std::to_string(coordinates.vertices.size()) + " vertices");
  FileMesh result;
  result.mesh.vertices = coordinates.vertices;
  std::set<int> used_materials;
  for (const auto& shape : shapes) {
    add_triangles(where, shape.mesh, coordinates, result);
    used_materials.insert(shape.mesh.material_ids.begin(), shape.mesh.material_ids.end());
  }
  for (int id : used_materials)
    if (id >= 0 && !materials[id].diffuse_texname.empty())
      add_image(path.parent_path(), materials[id].diffuse_texname, result);
  result.missing_material_file = reader.missing;
  result.may_be_split = !coordinates.uv.empty();
  return result;
}

}  // namespace dressform
