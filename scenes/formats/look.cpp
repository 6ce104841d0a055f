#include "scenes/formats/look.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <set>
#include <tuple>

#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/image_file.h"
#include "scenes/srgb.h"

namespace dressform {
namespace {

constexpr float kEdge = 1e-4f;  // texture coordinates this far beyond the image are rounding

std::set<int> used_materials(const FileMesh& file) { return {file.material.begin(), file.material.end()}; }

// Whole repeats of the image are taken off, triangle by triangle: what is left starts in [0, 1).
std::array<Vector2f, 3> unrepeated(std::array<Vector2f, 3> uv, const std::array<Wrap, 2>& wrap) {
  for (int k = 0; k < 2; ++k) {
    const auto [low, high] = std::minmax({uv[0][k], uv[1][k], uv[2][k]});
    if (wrap[k] != Wrap::repeat || (low >= -kEdge && high <= 1 + kEdge)) continue;
    const float shift = std::floor(low + kEdge);
    for (auto& corner : uv) corner[k] -= shift;
  }
  return uv;
}

bool is_within(const std::array<Vector2f, 3>& uv) {
  return std::all_of(uv.begin(), uv.end(),
                     [](const Vector2f& c) { return c.minCoeff() >= -kEdge && c.maxCoeff() <= 1 + kEdge; });
}

TextureImage decoded(const FileImage& image) {
  if (image.bytes.empty()) return decode_texture(image.file.string(), read_file_bytes(image.file, kMostMeshBytes));
  return decode_texture(image.file.string() + " (image inside)", image.bytes);
}

// Every used image once.
class Images {
 public:
  explicit Images(const FileMesh& file) : file_(file) {}
  const TextureImage& at(int image) {
    const auto [at, fresh] = known_.try_emplace(image);
    if (fresh) at->second = decoded(file_.images.at(static_cast<std::size_t>(image)));
    return at->second;
  }

 private:
  const FileMesh& file_;
  std::map<int, TextureImage> known_;
};

cv::Mat tinted(const cv::Mat& image, const FileMaterial& material) {
  if (material.tint == Vector3f::Ones()) return image;
  cv::Mat table(1, 256, CV_8UC3), result;
  for (int value = 0; value < 256; ++value)
    for (int k = 0; k < 3; ++k) {
      const float plain = static_cast<float>(value) / 255, tint = material.tint[k];
      const float product = material.tint_is_linear ? srgb_from_linear(tint * linear_from_srgb(plain)) : tint * plain;
      table.at<cv::Vec3b>(value)[2 - k] = cv::saturate_cast<std::uint8_t>(255 * product);
    }
  cv::LUT(image, table, result);
  return result;
}

TextureChart plain_chart(const FileMaterial& material) {
  TextureChart chart;
  chart.plain = true;
  chart.wrap = {Wrap::clamp, Wrap::clamp};
  cv::Scalar color;
  for (int k = 0; k < 3; ++k)
    color[2 - k] = 255 * (material.tint_is_linear ? srgb_from_linear(material.tint[k]) : material.tint[k]);
  chart.image = cv::Mat(16, 16, CV_8UC3, color);
  return chart;
}

// Opacity of each material's image, 8 bits; empty where it is opaque or does not matter.
std::vector<cv::Mat> opacities(const FileMesh& file, const std::set<int>& used, Images& images) {
  std::vector<cv::Mat> result(file.materials.size());
  for (int m : used) {
    if (m < 0 || file.materials[m].transparency == Transparency::ignored) continue;
    const FileMaterial& material = file.materials[m];
    if (material.opacity_image >= 0) {
      const TextureImage& image = images.at(material.opacity_image);
      result[m] = image.alpha;
      if (image.alpha.empty() && material.opacity_image != material.image) result[m] = image.brightness();
    } else if (material.image >= 0) {
      result[m] = images.at(material.image).alpha;
    }
  }
  return result;
}

// What two materials must share to be one chart.
auto look_of(const FileMaterial& m) {
  return std::make_tuple(m.image, m.tint.x(), m.tint.y(), m.tint.z(), m.tint_is_linear && m.image >= 0, m.wrap[0],
                         m.wrap[1]);
}

void check_coordinates(const std::string& where, const FileMesh& file, const FileMaterial& material, std::size_t t) {
  if (file.corner_uv.empty()) throw InputError(where, "found no texture coordinates; expected them at every corner");
  for (const auto& uv : file.corner_uv[t])
    if (!uv.allFinite())
      throw InputError(where, "triangle " + std::to_string(t) + " has a corner without texture coordinates");
  const bool once = material.wrap[0] == Wrap::nothing || material.wrap[1] == Wrap::nothing;
  if (once && !is_within(file.corner_uv[t]))
    throw InputError(where, "triangle " + std::to_string(t) + " goes beyond the image of material \"" + material.name +
                                "\", which has the option -clamp; expected texture coordinates from 0 to 1");
}

// The charts of all triangles, and the materials' names.
std::vector<TextureChart> charts_of(const FileMesh& file, Images& images, std::vector<std::string>& names,
                                    TexturedMesh& result) {
  FileMaterial none;
  none.name = "none";
  std::map<decltype(look_of(none)), std::size_t> known;
  std::vector<TextureChart> charts;
  for (std::size_t t = 0; t < file.mesh.triangles.size(); ++t) {
    const int number = file.material.empty() ? -1 : file.material[t];
    const FileMaterial& material = number < 0 ? none : file.materials[number];
    const auto [at, fresh] = known.try_emplace(look_of(material), charts.size());
    if (fresh) {
      charts.push_back(material.image < 0 ? plain_chart(material) : TextureChart{});
      names.push_back(material.name);
      if (material.image >= 0) {
        charts.back().image = tinted(images.at(material.image).bgr, material);
        charts.back().wrap = material.wrap;
      }
    }
    charts[at->second].triangles.push_back(t);
    if (material.image < 0) continue;
    result.corner_uv[t] = unrepeated(file.corner_uv[t], material.wrap);
  }
  return charts;
}

void throw_faults(const FileMesh& file, const std::set<int>& used) {
  for (int m : used)
    if (m >= 0 && file.materials[m].fault) throw InputError(*file.materials[m].fault);
}

bool is_white(const FileMesh& file) {
  return std::all_of(file.corner_color.begin(), file.corner_color.end(), [](const auto& colors) {
    return std::all_of(colors.begin(), colors.end(), [](const Vector3f& c) { return c.minCoeff() >= 1; });
  });
}

void check_all_coordinates(const std::string& where, const FileMesh& file) {
  for (std::size_t t = 0; t < file.material.size(); ++t)
    if (file.material[t] >= 0 && file.materials[file.material[t]].image >= 0)
      check_coordinates(where, file, file.materials[file.material[t]], t);
}

bool any_image(const FileMesh& file, const std::set<int>& used) {
  return std::any_of(used.begin(), used.end(), [&](int m) { return m >= 0 && file.materials[m].image >= 0; });
}

}  // namespace

bool has_look(const FileMesh& file) {
  const std::set<int> used = used_materials(file);
  return !file.corner_color.empty() || std::any_of(used.begin(), used.end(), [](int m) { return m >= 0; });
}

TexturedMesh with_one_texture(const std::string& where, FileMesh file) {
  throw_faults(file, used_materials(file));
  if (!has_look(file)) throw InputError(where, "names 0 images; expected a texture, or a material with a colour");
  check_all_coordinates(where, file);
  part_tiles(where, file);
  const std::set<int> used = used_materials(file);
  throw_faults(file, used);
  Images images(file);
  cut_holes(where, opacities(file, used, images), file);
  TexturedMesh result;
  if (!is_white(file) && !any_image(file, used)) {
    paint_corner_colors(where, file.corner_color, result);
  } else {
    result.corner_uv.resize(file.mesh.triangles.size());
    std::vector<std::string> names;
    const std::vector<TextureChart> charts = charts_of(file, images, names, result);
    const bool as_it_is = charts.size() == 1 && !charts[0].plain &&
                          std::all_of(result.corner_uv.begin(), result.corner_uv.end(), is_within);
    if (as_it_is)
      result.texture = charts[0].image;
    else
      lay_side_by_side(where, charts, names, result);
  }
  result.mesh = std::move(file.mesh);
  return result;
}

}  // namespace dressform
