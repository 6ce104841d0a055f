#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "scenes/file_bytes.h"
#include "scenes/mesh_io.h"

namespace dressform {
namespace {

template <class T>
void put(std::string& out, const T& value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(what);
}

std::uint8_t byte_of(float unit) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(unit, 0.0f, 1.0f))); }

// A PLY's header line by line, then its vertices.
class PlyVertices {
 public:
  PlyVertices(const std::vector<Vector3d>& points, const std::vector<Vector3d>& normals,
              const std::vector<Vector3f>& colors)
      : points_(points), normals_(normals), colors_(colors) {
    require(normals.empty() || normals.size() == points.size(), "write_ply: as many normals as vertices");
    require(colors.empty() || colors.size() == points.size(), "write_ply: as many colours as vertices");
    header_ =
        fmt::format("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n", points.size());
    if (!normals.empty()) header_ += "property float nx\nproperty float ny\nproperty float nz\n";
    if (!colors.empty()) header_ += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  }

  void add(const std::string& name, const std::vector<std::uint8_t>& values) {
    require(values.size() == points_.size(), "write_ply: as many values of a property as vertices");
    header_ += "property uchar " + name + "\n";
    bytes_.push_back(&values);
  }
  void add(const std::string& name, const std::vector<int>& values) {
    require(values.size() == points_.size(), "write_ply: as many values of a property as vertices");
    header_ += "property int " + name + "\n";
    numbers_.push_back(&values);
  }

  const std::string& header() const { return header_; }
  void append(std::string& out) const {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      for (int k = 0; k < 3; ++k) put(out, points_[i][k]);
      for (int k = 0; k < 3 && !normals_.empty(); ++k) put(out, static_cast<float>(normals_[i][k]));
      for (int k = 0; k < 3 && !colors_.empty(); ++k) put(out, byte_of(colors_[i][k]));
      for (const auto* values : bytes_) put(out, (*values)[i]);
      for (const auto* values : numbers_) put(out, static_cast<std::int32_t>((*values)[i]));
    }
  }

 private:
  const std::vector<Vector3d>&points_, &normals_;
  const std::vector<Vector3f>& colors_;
  std::string header_;
  std::vector<const std::vector<std::uint8_t>*> bytes_;
  std::vector<const std::vector<int>*> numbers_;
};

const char* kPlyStart = "ply\nformat binary_little_endian 1.0\n";

std::string encoded_png(const cv::Mat& texture) {
  require(!texture.empty() && texture.type() == CV_8UC3, "writing a textured mesh: texture is 8-bit BGR");
  std::vector<std::uint8_t> png;
  cv::imencode(".png", texture, png);
  return {png.begin(), png.end()};
}

}  // namespace

void write_ply(const std::filesystem::path& path, const Mesh& mesh, const PlyExtras& extras) {
  require(extras.corner_uv.empty() || extras.corner_uv.size() == mesh.triangles.size(),
          "write_ply: texture coordinates for every triangle");
  PlyVertices vertices(mesh.vertices, extras.normals, extras.colors);
  for (const auto& [name, values] : extras.vertex_properties) vertices.add(name, values);
  std::string out = kPlyStart;
  if (!extras.texture_file.empty()) out += "comment TextureFile " + extras.texture_file + "\n";
  out += vertices.header();
  out += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", mesh.triangles.size());
  if (!extras.corner_uv.empty()) out += "property list uchar float texcoord\n";
  out += "end_header\n";
  vertices.append(out);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    put(out, std::uint8_t{3});
    for (int k = 0; k < 3; ++k) put(out, static_cast<std::int32_t>(mesh.triangles[i][k]));
    if (extras.corner_uv.empty()) continue;
    put(out, std::uint8_t{6});
    for (const auto& uv : extras.corner_uv[i]) {
      put(out, uv.x());
      put(out, 1 - uv.y());
    }
  }
  write_file_atomically(path, out);
}

void write_ply(const std::filesystem::path& path, const PointCloud& cloud) {
  PlyVertices vertices(cloud.points, cloud.normals, cloud.colors);
  if (!cloud.views.empty()) vertices.add("view", cloud.views);
  std::string out = kPlyStart + vertices.header() + "end_header\n";
  vertices.append(out);
  write_file_atomically(path, out);
}

void write_obj(const std::filesystem::path& path, const TexturedMesh& textured) {
  require(textured.corner_uv.size() == textured.mesh.triangles.size(), "write_obj: uv for every triangle");
  const std::string stem = path.stem().string();
  fmt::memory_buffer out;
  const auto to = std::back_inserter(out);
  fmt::format_to(to, "mtllib {}.mtl\nusemtl cloth\n", stem);
  for (const auto& v : textured.mesh.vertices) fmt::format_to(to, "v {} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& corners : textured.corner_uv)
    for (const auto& uv : corners) fmt::format_to(to, "vt {} {}\n", uv.x(), 1 - uv.y());
  for (std::size_t i = 0; i < textured.mesh.triangles.size(); ++i) {
    const Vector3i t = textured.mesh.triangles[i] + Vector3i::Ones();
    fmt::format_to(to, "f {}/{} {}/{} {}/{}\n", t[0], 3 * i + 1, t[1], 3 * i + 2, t[2], 3 * i + 3);
  }
  const auto beside = [&](const char* extension) { return std::filesystem::path(path).replace_extension(extension); };
  write_file_atomically(beside(".png"), encoded_png(textured.texture));
  write_file_atomically(beside(".mtl"),
                        fmt::format("newmtl cloth\nKa 0 0 0\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd {}.png\n", stem));
  write_file_atomically(path, fmt::to_string(out));
}

}  // namespace dressform
