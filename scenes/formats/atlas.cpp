#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scenes/error.h"
#include "scenes/formats/look.h"

namespace dressform {
namespace {

constexpr int kBorder = 16;  // texels round a chart, and its alignment: four halvings do not mix charts

// The part of a chart's endless image that its triangles touch, in texels.
struct Part {
  int left = 0, top = 0, width = 0, height = 0;  // with the border
  int x = 0, y = 0;                              // where it lies in the texture
};

int aligned(int size) { return (size + kBorder - 1) / kBorder * kBorder; }

[[noreturn]] void too_large(const std::string& where, const std::string& what) {
  throw InputError(where, fmt::format("{}; expected at most {} texels a side and {:.0f} in all", what, kMostTextureSide,
                                      kMostTexturePixels));
}

Part plain_part() { return {-kBorder / 2, -kBorder / 2, 2 * kBorder, 2 * kBorder, 0, 0}; }

Part touched_part(const std::string& where, const TextureChart& chart, const std::string& name,
                  const TexturedMesh& mesh) {
  if (chart.plain) return plain_part();
  Vector2f low = Vector2f::Constant(INFINITY), high = -low;
  for (std::size_t t : chart.triangles)
    for (const Vector2f& uv : mesh.corner_uv[t]) {
      low = low.cwiseMin(uv);
      high = high.cwiseMax(uv);
    }
  const Vector2f size(static_cast<float>(chart.image.cols), static_cast<float>(chart.image.rows));
  const Vector2f first = low.cwiseProduct(size), last = high.cwiseProduct(size);
  if (!((last - first).maxCoeff() < kMostTextureSide) || first.cwiseAbs().maxCoeff() > 1e6f)
    too_large(where, fmt::format("material \"{}\" repeats its image {:.0f} times beside other materials", name,
                                 std::ceil((high - low).maxCoeff())));
  Part part;
  part.left = static_cast<int>(std::floor(first.x())) - kBorder;
  part.top = static_cast<int>(std::floor(first.y())) - kBorder;
  part.width = aligned(static_cast<int>(std::ceil(last.x())) + kBorder - part.left);
  part.height = aligned(static_cast<int>(std::ceil(last.y())) + kBorder - part.top);
  return part;
}

// Places the parts on shelves, the highest first; returns the texture's size.
cv::Size placed(const std::string& where, std::vector<Part>& parts) {
  double area = 0;
  int widest = 0;
  for (const Part& part : parts) {
    area += double(part.width) * part.height;
    widest = std::max(widest, part.width);
  }
  const int width = std::max(widest, aligned(static_cast<int>(std::sqrt(std::min(area, 1e9)))));
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return parts[a].height > parts[b].height; });
  int x = 0, y = 0, shelf = 0, used = 0;
  for (std::size_t i : order) {
    if (x + parts[i].width > width) {
      x = 0;
      y += shelf;
      shelf = 0;
    }
    parts[i].x = x;
    parts[i].y = y;
    x += parts[i].width;
    used = std::max(used, x);
    shelf = std::max(shelf, parts[i].height);
    if (used > kMostTextureSide || y + shelf > kMostTextureSide || double(used) * (y + shelf) > kMostTexturePixels)
      too_large(where,
                fmt::format("its {} materials need a texture of more than {} x {}", parts.size(), used, y + shelf));
  }
  return {used, y + shelf};
}

void copy_part(const TextureChart& chart, const Part& part, cv::Mat& texture) {
  std::vector<int> column(static_cast<std::size_t>(part.width));
  for (int i = 0; i < part.width; ++i) column[i] = wrapped(part.left + i, chart.image.cols, chart.wrap[0]);
  for (int j = 0; j < part.height; ++j) {
    const auto* from = chart.image.ptr<cv::Vec3b>(wrapped(part.top + j, chart.image.rows, chart.wrap[1]));
    auto* to = texture.ptr<cv::Vec3b>(part.y + j) + part.x;
    for (int i = 0; i < part.width; ++i) to[i] = from[column[i]];
  }
}

}  // namespace

int wrapped(int i, int size, Wrap wrap) {
  if (wrap == Wrap::clamp || wrap == Wrap::nothing) return std::clamp(i, 0, size - 1);
  const int period = wrap == Wrap::mirror ? 2 * size : size;
  const int within = (i % period + period) % period;
  return within < size ? within : period - 1 - within;
}

void lay_side_by_side(const std::string& where, const std::vector<TextureChart>& charts,
                      const std::vector<std::string>& names, TexturedMesh& result) {
  std::vector<Part> parts;
  for (std::size_t c = 0; c < charts.size(); ++c) parts.push_back(touched_part(where, charts[c], names[c], result));
  const cv::Size size = placed(where, parts);
  result.texture = cv::Mat(size, CV_8UC3, cv::Scalar::all(0));
  const Eigen::Vector2d whole(size.width, size.height);
  for (std::size_t c = 0; c < charts.size(); ++c) {
    const Part& part = parts[c];
    copy_part(charts[c], part, result.texture);
    const Eigen::Vector2d image(charts[c].image.cols, charts[c].image.rows);
    const Eigen::Vector2d shift(part.x - part.left, part.y - part.top);
    const std::array<Vector2f, 3> within{Vector2f(0.25f, 0.25f), Vector2f(0.25f, 0.75f), Vector2f(0.75f, 0.25f)};
    for (std::size_t t : charts[c].triangles)
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector2d uv = (charts[c].plain ? within[k] : result.corner_uv[t][k]).cast<double>();
        result.corner_uv[t][k] = (uv.cwiseProduct(image) + shift).cwiseQuotient(whole).cast<float>();
      }
  }
}

void paint_corner_colors(const std::string& where, const std::vector<std::array<Vector3f, 3>>& corner_color,
                         TexturedMesh& result) {
  constexpr std::size_t kFew = 500'000;  // triangles that get a wider patch, which bears more halvings
  const int cell = corner_color.size() <= kFew ? 8 : 4;
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(corner_color.size()))));
  const int rows = static_cast<int>((corner_color.size() + static_cast<std::size_t>(columns) - 1) /
                                    static_cast<std::size_t>(columns));
  if (double(columns) * cell > kMostTextureSide || double(columns) * rows * cell * cell > kMostTexturePixels)
    too_large(where, fmt::format("the vertex colours of {} triangles need too large a texture", corner_color.size()));
  result.texture = cv::Mat(rows * cell, columns * cell, CV_8UC3, cv::Scalar::all(0));
  result.corner_uv.resize(corner_color.size());
  const auto width = static_cast<float>(columns * cell), height = static_cast<float>(rows * cell);
  const float side = static_cast<float>(cell - 3);  // texels from corner to corner
  for (std::size_t t = 0; t < corner_color.size(); ++t) {
    const int x0 = static_cast<int>(t) % columns * cell, y0 = static_cast<int>(t) / columns * cell;
    const auto& color = corner_color[t];
    for (int y = 0; y < cell; ++y)
      for (int x = 0; x < cell; ++x) {
        const Vector3f rgb = color[0] + static_cast<float>(x - 1) / side * (color[1] - color[0]) +
                             static_cast<float>(y - 1) / side * (color[2] - color[0]);
        auto& texel = result.texture.at<cv::Vec3b>(y0 + y, x0 + x);
        for (int k = 0; k < 3; ++k) texel[2 - k] = cv::saturate_cast<std::uint8_t>(255 * rgb[k]);
      }
    const auto place = [&](int x, int y) {
      return Vector2f((static_cast<float>(x0 + x) + 0.5f) / width, (static_cast<float>(y0 + y) + 0.5f) / height);
    };
    result.corner_uv[t] = {place(1, 1), place(cell - 2, 1), place(1, cell - 2)};
  }
}

}  // namespace dressform
