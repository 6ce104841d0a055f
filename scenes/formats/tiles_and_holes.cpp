#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <regex>

#include "scenes/error.h"
#include "scenes/formats/look.h"

namespace dressform {
namespace {

constexpr float kEdge = 1e-4f;  // a corner this far beyond its tile is rounding

// A file name of one tile of several: what stands before and after the tile's number.
struct TileName {
  std::filesystem::path folder;
  std::string before, after;
  bool tagged = false;  // the number is written as <UDIM>
  std::filesystem::path at(int number) const { return folder / (before + std::to_string(number) + after); }
};

std::optional<TileName> tile_name(const std::filesystem::path& file) {
  static const std::regex tag("(.*)<UDIM>(.*)", std::regex::icase), first("(.*[._])1001(\\.[A-Za-z]+)");
  const std::string name = file.filename().string();
  constexpr std::size_t kLongest = 255;  // of a file name, in bytes
  std::smatch parts;
  if (name.size() > kLongest) return {};
  if (std::regex_match(name, parts, tag)) return TileName{file.parent_path(), parts[1], parts[2], true};
  if (std::regex_match(name, parts, first)) return TileName{file.parent_path(), parts[1], parts[2], false};
  return {};
}

// The tile (column, row from the bottom) in which a triangle lies; nothing where it goes over a tile's edge.
std::optional<std::pair<int, int>> tile_of(const std::array<Vector2f, 3>& uv) {
  const Vector2f middle = (uv[0] + uv[1] + uv[2]) / 3;
  if (!middle.allFinite() || middle.cwiseAbs().maxCoeff() > 1e4f) return {};
  const int column = static_cast<int>(std::floor(middle.x())), row = static_cast<int>(std::floor(1 - middle.y()));
  for (const Vector2f& corner : uv) {
    const Vector2f within(corner.x() - static_cast<float>(column), 1 - corner.y() - static_cast<float>(row));
    if (within.minCoeff() < -kEdge || within.maxCoeff() > 1 + kEdge) return {};
  }
  return std::pair(column, row);
}

bool lies_in_first_tile(const FileMesh& file, int material) {
  for (std::size_t t = 0; t < file.corner_uv.size(); ++t)
    if (file.material[t] == material && tile_of(file.corner_uv[t]) != std::pair(0, 0)) return false;
  return true;
}

// Gives each tile of one material a material of its own.
class TileParting {
 public:
  TileParting(const std::string& where, FileMesh& file, int material, TileName name)
      : where_(where), file_(file), material_(material), name_(std::move(name)) {}

  void part() {
    for (std::size_t t = 0; t < file_.corner_uv.size(); ++t) {
      if (file_.material[t] != material_) continue;
      const auto tile = tile_of(file_.corner_uv[t]);
      if (!tile || tile->first < 0 || tile->first > 9 || tile->second < 0 || tile->second > 99)
        throw InputError(where_, "triangle " + std::to_string(t) + " lies in no UDIM tile of \"" +
                                     file_.materials[material_].name +
                                     "\" alone; expected texture coordinates within one tile from 1001 on");
      file_.material[t] = material_of(*tile);
      for (Vector2f& uv : file_.corner_uv[t])
        uv += Vector2f(-static_cast<float>(tile->first), static_cast<float>(tile->second));
    }
  }

 private:
  int material_of(std::pair<int, int> tile) {
    const auto [at, fresh] = numbers_.try_emplace(tile, static_cast<int>(file_.materials.size()));
    if (fresh) {
      FileMaterial material = file_.materials[material_];
      const auto image = name_.at(1001 + tile.first + 10 * tile.second);
      std::error_code error;
      if (!std::filesystem::exists(image, error))
        throw InputError(image.string(), "found no such file; " + where_ + " has faces in this UDIM tile");
      const bool own_opacity = material.opacity_image >= 0 && material.opacity_image != material.image;
      if (own_opacity)
        throw InputError(where_, "has an opacity image (map_d) beside UDIM tiles; expected alpha in the tiles");
      material.image = static_cast<int>(file_.images.size());
      if (material.opacity_image >= 0) material.opacity_image = material.image;
      file_.images.push_back({image, {}});
      file_.materials.push_back(material);
    }
    return at->second;
  }

  const std::string& where_;
  FileMesh& file_;
  int material_;
  TileName name_;
  std::map<std::pair<int, int>, int> numbers_;
};

// How many texels in a triangle are there and how many are holes or between.
struct Seen {
  int opaque = 0, clear = 0, between = 0;
};

// Opacity as a material reads it.
class Opacity {
 public:
  Opacity(const cv::Mat& alpha, const FileMaterial& material) : alpha_(alpha), material_(material) {}

  bool matters() const {
    return alpha_.empty() ? material_.transparency != Transparency::ignored && material_.opacity < kOpaque : true;
  }

  Seen within(const std::array<Vector2f, 3>& uv) const {
    Seen seen;
    if (alpha_.empty()) {
      add(1, seen);
      return seen;
    }
    std::array<Vector2f, 3> p;
    for (int k = 0; k < 3; ++k) p[k] = uv[k].cwiseProduct(Vector2f(alpha_.cols, alpha_.rows)) - Vector2f(0.5f, 0.5f);
    const Vector2f low = p[0].cwiseMin(p[1]).cwiseMin(p[2]), high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
    if (!((high - low).maxCoeff() < 2 * kMostTextureSide) || low.cwiseAbs().maxCoeff() > 1e6f) return {0, 0, 1};
    for (int y = static_cast<int>(std::ceil(low.y())); y <= high.y(); ++y)
      for (int x = static_cast<int>(std::ceil(low.x())); x <= high.x(); ++x)
        if (is_inside(p, Vector2f(static_cast<float>(x), static_cast<float>(y)))) add(texel(x, y), seen);
    if (seen.opaque + seen.clear + seen.between == 0) {  // smaller than a texel
      const Vector2f middle = (p[0] + p[1] + p[2]) / 3;
      add(texel(static_cast<int>(std::lround(middle.x())), static_cast<int>(std::lround(middle.y()))), seen);
    }
    return seen;
  }

 private:
  static constexpr double kOpaque = 0.98, kClear = 0.02;  // rounding of a JPEG or a resampled image

  static bool is_inside(const std::array<Vector2f, 3>& p, const Vector2f& q) {
    const auto side = [&](int k) {
      const Vector2f edge = p[(k + 1) % 3] - p[k], to = q - p[k];
      return edge.x() * to.y() - edge.y() * to.x();
    };
    const float a = side(0), b = side(1), c = side(2);
    return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
  }

  double texel(int x, int y) const {
    return alpha_.at<std::uint8_t>(wrapped(y, alpha_.rows, material_.wrap[1]),
                                   wrapped(x, alpha_.cols, material_.wrap[0])) /
           255.0;
  }

  void add(double alpha, Seen& seen) const {
    alpha *= material_.opacity;
    if (material_.transparency == Transparency::holes)
      ++(alpha >= material_.cutoff ? seen.opaque : seen.clear);
    else
      ++(alpha >= kOpaque ? seen.opaque : alpha <= kClear ? seen.clear : seen.between);
  }

  const cv::Mat& alpha_;
  const FileMaterial& material_;
};

}  // namespace

void part_tiles(const std::string& where, FileMesh& file) {
  const int count = static_cast<int>(file.materials.size());
  if (file.corner_uv.empty() || file.material.empty()) return;
  for (int m = 0; m < count; ++m) {
    const int image = file.materials[m].image;
    if (image < 0 || !file.images[image].bytes.empty()) continue;
    const auto name = tile_name(file.images[image].file);
    if (!name || (!name->tagged && lies_in_first_tile(file, m))) continue;
    TileParting(where, file, m, *name).part();
  }
}

void cut_holes(const std::string& where, const std::vector<cv::Mat>& opacity, FileMesh& file) {
  std::vector<Opacity> readers;
  for (std::size_t m = 0; m < file.materials.size(); ++m) readers.emplace_back(opacity[m], file.materials[m]);
  if (std::none_of(readers.begin(), readers.end(), [](const Opacity& o) { return o.matters(); })) return;
  std::vector<char> kept(file.mesh.triangles.size(), 1);
  std::size_t mixed = 0, first_mixed = 0;
  for (std::size_t t = 0; t < kept.size(); ++t) {
    const int m = file.material[t];
    if (m < 0 || !readers[m].matters()) continue;
    const Seen seen = readers[m].within(file.corner_uv.empty() ? std::array<Vector2f, 3>{} : file.corner_uv[t]);
    kept[t] = seen.clear == 0;
    if (seen.between == 0 && (seen.clear == 0 || seen.opaque == 0)) continue;
    if (mixed++ == 0) first_mixed = t;
  }
  if (mixed > 0)
    throw InputError(where, std::to_string(mixed) + " triangles (the first is " + std::to_string(first_mixed) +
                                ", material \"" + file.materials[file.material[first_mixed]].name +
                                "\") are partly holes or translucent in the image's alpha (opacity); expected opaque "
                                "cloth, or holes that end where triangles end");
  keep_triangles(kept, file);
  if (file.mesh.triangles.empty()) throw InputError(where, "is a hole everywhere (alpha); expected opaque cloth");
  if (file.mesh.triangles.size() < kept.size()) file.mesh = compacted(file.mesh);
}

}  // namespace dressform
