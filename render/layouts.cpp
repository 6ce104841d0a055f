#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "render/geometry.h"
#include "render/renderer.h"

namespace dressform {
namespace {

constexpr double kMargin = 1.04;  // room round the box
constexpr double kFovDeg = 30;
constexpr double kDegree = M_PI / 180;

// What a box turns through when it is turned about its vertical axis.
struct Cylinder {
  double radius, half_height;
};

Cylinder cylinder_of(const Eigen::AlignedBox3d& box) {
  const Vector3d half = 0.5 * box.sizes();
  return {std::max(std::hypot(half.x(), half.z()), 1e-3), std::max(half.y(), 1e-3)};
}

// Distance from which the whole cylinder is seen within the half angles' tangents, from the given elevation.
double framing_distance(const Cylinder& cylinder, double elevation, double tan_x, double tan_y) {
  double distance = 0;
  for (int i = 0; i < 64; ++i) {
    const double angle = i * M_PI / 32;
    for (const double y : {-cylinder.half_height, cylinder.half_height}) {
      const double x = cylinder.radius * std::sin(angle), z = cylinder.radius * std::cos(angle);
      const double up = y * std::cos(elevation) - z * std::sin(elevation);
      const double towards = y * std::sin(elevation) + z * std::cos(elevation);
      distance = std::max(distance, towards + std::max(std::abs(up) / tan_y, std::abs(x) / tan_x));
    }
  }
  return distance;
}

Eigen::AlignedBox3d checked_box(const std::vector<RenderItem>& items) {
  for (const RenderItem& item : items) check_item(item);
  Eigen::AlignedBox3d box = bounding_box(items);
  if (box.isEmpty()) throw std::invalid_argument("render: there is nothing to draw");
  return box;
}

// Width of a tile that a turning box fills.
int tile_width(const Eigen::AlignedBox3d& box, int height) {
  const Cylinder cylinder = cylinder_of(box);
  return std::max(8,
                  static_cast<int>(std::lround(height * std::clamp(cylinder.radius / cylinder.half_height, 0.4, 1.6))));
}

cv::Mat tiled(const std::vector<cv::Mat>& tiles, int columns, const RenderOptions& options) {
  const int rows = (static_cast<int>(tiles.size()) + columns - 1) / columns;
  const cv::Size size = tiles.front().size();
  const Eigen::Vector3f back = options.background * 255;
  const cv::Scalar fill =
      options.transparent_background ? cv::Scalar::all(0) : cv::Scalar(back.z(), back.y(), back.x(), 255);
  cv::Mat sheet(rows * size.height, columns * size.width, tiles.front().type(), fill);
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const int row = static_cast<int>(i) / columns, column = static_cast<int>(i) % columns;
    tiles[i].copyTo(sheet(cv::Rect({column * size.width, row * size.height}, size)));
  }
  return sheet;
}

cv::Mat turned(Renderer& renderer, const std::vector<RenderItem>& items, int count, int columns, double elevation_deg,
               int tile_height, const RenderOptions& options) {
  if (count < 1 || columns < 1 || tile_height < 8)
    throw std::invalid_argument("render: a sheet needs views, columns and tiles of at least 8 pixels");
  const Eigen::AlignedBox3d box = checked_box(items);
  std::vector<RenderView> views;
  for (int i = 0; i < count; ++i)
    views.push_back(look_at_box(box.min(), box.max(), 360.0 * i / count, elevation_deg, tile_width(box, tile_height),
                                tile_height, kFovDeg));
  return tiled(renderer.render(views, items, options), std::min(columns, count), options);
}

}  // namespace

RenderView look_at_box(const Vector3d& minimum, const Vector3d& maximum, double azimuth_deg, double elevation_deg,
                       int width, int height, double fov_deg) {
  if (!(minimum.array() <= maximum.array()).all() || width < 1 || height < 1 || !(fov_deg > 0 && fov_deg < 170))
    throw std::invalid_argument("render: look_at_box needs a box, a size and an angle of view");
  const double azimuth = azimuth_deg * kDegree, elevation = elevation_deg * kDegree;
  const double focal = 0.5 * height / std::tan(0.5 * fov_deg * kDegree);
  RenderView view;
  view.camera.width = width;
  view.camera.height = height;
  view.camera.fx = view.camera.fy = focal;
  view.camera.cx = 0.5 * (width - 1);
  view.camera.cy = 0.5 * (height - 1);
  const double distance = framing_distance(cylinder_of(Eigen::AlignedBox3d(minimum, maximum)), elevation,
                                           0.5 * width / focal / kMargin, 0.5 * height / focal / kMargin);
  const Vector3d to_camera(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                           std::cos(azimuth) * std::cos(elevation));
  const Vector3d right(std::cos(azimuth), 0, -std::sin(azimuth));
  Eigen::Matrix3d camera_from_world;
  camera_from_world.row(0) = right;
  camera_from_world.row(1) = -to_camera.cross(right);
  camera_from_world.row(2) = -to_camera;
  view.camera_from_world.linear() = camera_from_world;
  view.camera_from_world.translation() = -camera_from_world * (0.5 * (minimum + maximum) + distance * to_camera);
  return view;
}

cv::Mat four_views(Renderer& renderer, const std::vector<RenderItem>& items, int height, const RenderOptions& options) {
  return turned(renderer, items, 4, 4, 0, height, options);
}

cv::Mat contact_sheet(Renderer& renderer, const std::vector<RenderItem>& items, int count, int columns, int tile_height,
                      const RenderOptions& options) {
  return turned(renderer, items, count, columns, 12, tile_height, options);
}

}  // namespace dressform
