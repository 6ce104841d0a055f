#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "scenes/file_bytes.h"
#include "scenes/formats/file_mesh.h"
#include "scenes/formats/mtl.h"
#include "scenes/formats/obj_file.h"
#include "scenes/formats/polygon.h"

namespace dressform {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// Files that an mtllib line names: the whole rest of the line where that is a file, else name by name. A name goes on
// over blanks up to ".mtl".
std::vector<std::filesystem::path> libraries_of(const std::filesystem::path& obj, const std::string& line) {
  std::error_code error;
  const auto whole = beside(obj, line);
  if (std::filesystem::is_regular_file(whole, error)) return {whole};
  std::vector<std::filesystem::path> files;
  std::string name;
  for (std::size_t at = 0; at <= line.size(); ++at) {
    const bool ends = at == line.size() || is_blank(line[at]);
    if (!ends) {
      name += line[at];
      continue;
    }
    std::string end = name.size() < 4 ? "" : name.substr(name.size() - 4);
    std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return std::tolower(c); });
    if (at < line.size() && end != ".mtl") {
      name += line[at];
      continue;
    }
    if (!trimmed(name).empty()) files.push_back(beside(obj, trimmed(name)));
    name.clear();
  }
  return files;
}

int image_number(const std::filesystem::path& file, std::vector<FileImage>& images) {
  if (file.empty()) return -1;
  const auto known = std::find_if(images.begin(), images.end(), [&](const FileImage& i) { return i.file == file; });
  const int number = static_cast<int>(known - images.begin());
  if (known == images.end()) images.push_back({file, {}});
  return number;
}

// The image as the library's folder has it, or the OBJ's, where the two differ.
std::filesystem::path found_image(const std::filesystem::path& file, const std::filesystem::path& obj,
                                  const std::filesystem::path& library) {
  std::error_code error;
  if (file.empty() || std::filesystem::exists(file, error)) return file;
  const auto beside_obj = obj.parent_path() / file.lexically_relative(library.parent_path());
  return std::filesystem::exists(beside_obj, error) ? beside_obj : file;
}

// The materials that faces use, in their order, and how their images lie.
std::vector<std::array<Vector2f, 2>> read_materials(const std::filesystem::path& path, const ObjFile& file,
                                                    FileMesh& result) {
  std::map<std::string, MtlMaterial> known;
  std::optional<InputError> lost;
  std::error_code error;
  for (const auto& line : file.libraries)
    for (const auto& library : libraries_of(path, line)) {
      if (!std::filesystem::is_regular_file(library, error)) {
        if (!lost) lost.emplace(library.string(), "found no such file; " + path.string() + " names it (mtllib)");
        continue;
      }
      std::map<std::string, MtlMaterial> own;
      read_mtl(library, own);
      result.libraries.push_back(library);
      for (auto& [name, material] : own) {
        material.color_file = found_image(material.color_file, path, library);
        material.opacity_file = found_image(material.opacity_file, path, library);
        known.emplace(name, std::move(material));
      }
    }
  std::vector<std::array<Vector2f, 2>> lies;
  for (const auto& name : file.materials) {
    const auto found = known.find(name);
    MtlMaterial material = found != known.end() ? found->second : MtlMaterial{};
    material.material.name = name;
    if (found == known.end() && lost) material.material.fault = lost;
    if (found == known.end() && !lost)
      material.material.fault.emplace(path.string(), "usemtl \"" + name +
                                                         "\": found no such material; expected one of its " +
                                                         std::to_string(known.size()) + " (mtllib)");
    material.material.image = image_number(material.color_file, result.images);
    material.material.opacity_image = image_number(material.opacity_file, result.images);
    result.materials.push_back(material.material);
    lies.push_back(material.scale_offset);
  }
  if (lost && file.materials.empty()) {  // said nevertheless: the file means to have a look
    result.materials.emplace_back().fault = lost;
    lies.emplace_back(MtlMaterial{}.scale_offset);
  }
  return lies;
}

// Adds the triangles of all polygons.
class Triangles {
 public:
  Triangles(const std::filesystem::path& path, const ObjFile& file, const std::vector<std::array<Vector2f, 2>>& lies,
            FileMesh& result)
      : path_(path), file_(file), lies_(lies), result_(result) {}

  void add(std::size_t first, const ObjFile::Polygon& polygon) {
    outline_.clear();
    triangles_.clear();
    for (std::size_t i = first; i < polygon.end; ++i) outline_.push_back(file_.vertices[file_.corners[i].vertex]);
    if (!triangulate(outline_, triangles_))
      throw InputError(path_.string() + ":" + std::to_string(polygon.line),
                       "found a face of " + std::to_string(outline_.size()) +
                           " corners whose outline crosses itself; expected a plane polygon");
    for (const auto& t : triangles_) add(first, t, polygon.material);
  }

 private:
  void add(std::size_t first, const std::array<int, 3>& triangle, int material) {
    const auto corner = [&](int k) { return file_.corners[first + triangle[k]]; };
    result_.mesh.triangles.emplace_back(corner(0).vertex, corner(1).vertex, corner(2).vertex);
    if (!result_.materials.empty()) result_.material.push_back(material < 0 && file_.materials.empty() ? 0 : material);
    if (!file_.uv.empty())
      result_.corner_uv.push_back({uv(corner(0), material), uv(corner(1), material), uv(corner(2), material)});
    if (!file_.colors.empty())
      result_.corner_color.push_back(
          {file_.colors[corner(0).vertex], file_.colors[corner(1).vertex], file_.colors[corner(2).vertex]});
  }

  Vector2f uv(const ObjFile::Corner& corner, int material) const {
    if (corner.uv < 0) return {kNone, kNone};
    Vector2f up = file_.uv[corner.uv];
    if (material >= 0 && material < static_cast<int>(lies_.size()))
      up = up.cwiseProduct(lies_[material][0]) + lies_[material][1];
    return {up.x(), 1 - up.y()};
  }

  const std::filesystem::path& path_;
  const ObjFile& file_;
  const std::vector<std::array<Vector2f, 2>>& lies_;
  FileMesh& result_;
  std::vector<Vector3d> outline_;
  std::vector<std::array<int, 3>> triangles_;
};

}  // namespace

FileMesh read_obj_mesh(const std::filesystem::path& path, Wanted wanted) {
  const std::string text = read_file_bytes(path, kMostMeshBytes);
  ObjFile file = read_obj_file(path, text);
  FileMesh result;
  result.may_be_split = !file.uv.empty();
  std::vector<std::array<Vector2f, 2>> lies;
  if (wanted == Wanted::look && !file.libraries.empty()) lies = read_materials(path, file, result);
  if (wanted == Wanted::shape) file.uv.clear();
  if (wanted == Wanted::shape) file.colors.clear();
  if (!file.colors.empty()) file.colors.resize(file.vertices.size(), Vector3f::Ones());
  Triangles triangles(path, file, lies, result);
  std::size_t first = 0;
  for (const auto& polygon : file.polygons) {
    triangles.add(first, polygon);
    first = polygon.end;
  }
  result.mesh.vertices = std::move(file.vertices);
  return result;
}

}  // namespace dressform
