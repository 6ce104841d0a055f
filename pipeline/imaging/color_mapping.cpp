#include "pipeline/imaging/color_mapping.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <vector>

#include "scenes/error.h"

namespace dressform {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

struct Corner {
  float u, v;            // colour pixel
  float x, y;            // depth pixel
  float z_mm, depth_mm;  // in the colour and in the IR camera frame
};

// Writes one triangle into the map, nearest surface wins. Depth pixels are interpolated linearly on the screen: a
// triangle is a few colour pixels wide.
void rasterize(const Corner& a, const Corner& b, const Corner& c, ColorDepthMap& map) {
  const float area = (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v);
  if (!(std::abs(area) > 1e-6f)) return;
  const int left = std::max(0, static_cast<int>(std::ceil(std::min({a.u, b.u, c.u}))));
  const int right = std::min(map.z_mm.cols - 1, static_cast<int>(std::floor(std::max({a.u, b.u, c.u}))));
  const int top = std::max(0, static_cast<int>(std::ceil(std::min({a.v, b.v, c.v}))));
  const int bottom = std::min(map.z_mm.rows - 1, static_cast<int>(std::floor(std::max({a.v, b.v, c.v}))));
  for (int v = top; v <= bottom; ++v) {
    for (int u = left; u <= right; ++u) {
      const float wb = ((u - a.u) * (c.v - a.v) - (c.u - a.u) * (v - a.v)) / area;
      const float wc = ((b.u - a.u) * (v - a.v) - (u - a.u) * (b.v - a.v)) / area;
      const float wa = 1 - wb - wc;
      if (wa < 0 || wb < 0 || wc < 0) continue;
      const float z = wa * a.z_mm + wb * b.z_mm + wc * c.z_mm;
      float& stored = map.z_mm.at<float>(v, u);
      if (stored > 0 && stored <= z) continue;
      stored = z;
      map.depth_mm.at<float>(v, u) = wa * a.depth_mm + wb * b.depth_mm + wc * c.depth_mm;
      map.depth_pixel.at<cv::Vec2f>(v, u) = {wa * a.x + wb * b.x + wc * c.x, wa * a.y + wb * b.y + wc * c.y};
    }
  }
}

// The colour pixel and depths of every depth pixel; u is NaN where there is none.
std::vector<Corner> corners_of(const cv::Mat& depth_mm, const SensorCalibration& sensor) {
  const cv::Mat points = depth_points_m(depth_mm, sensor.ir);
  std::vector<Corner> corners(points.total());
  for (int y = 0; y < points.rows; ++y) {
    for (int x = 0; x < points.cols; ++x) {
      Corner& corner = corners[static_cast<std::size_t>(y) * points.cols + x];
      corner = {kNaN, kNaN, static_cast<float>(x), static_cast<float>(y), 0, depth_mm.at<float>(y, x)};
      const auto& point = points.at<cv::Vec3f>(y, x);
      if (std::isnan(point[2])) continue;
      const Vector3d in_color = sensor.color_from_ir * Vector3d(point[0], point[1], point[2]);
      constexpr double kInFront_m = 0.05;
      if (in_color.z() <= kInFront_m) continue;
      const Vector2d pixel = sensor.color->project(in_color);
      corner.u = static_cast<float>(pixel.x());
      corner.v = static_cast<float>(pixel.y());
      corner.z_mm = static_cast<float>(1000 * in_color.z());
    }
  }
  return corners;
}

bool joined(const Corner& a, const Corner& b, const Corner& c, double max_jump_mm) {
  if (std::isnan(a.u) || std::isnan(b.u) || std::isnan(c.u)) return false;
  const auto [low, high] = std::minmax({a.depth_mm, b.depth_mm, c.depth_mm});
  return high - low <= max_jump_mm;
}

void require_color(const SensorCalibration& sensor) {
  if (!sensor.color) throw InputError("calibration.json", "found no colour camera; expected one for every view");
}

template <class T>
void gather(const cv::Mat& image, const cv::Mat& pixels, cv::Mat& out) {
  for (int y = 0; y < out.rows; ++y) {
    for (int x = 0; x < out.cols; ++x) {
      const auto& pixel = pixels.at<cv::Vec2f>(y, x);
      if (std::isnan(pixel[0])) continue;
      const int u = cvRound(pixel[0]), v = cvRound(pixel[1]);
      if (u >= 0 && v >= 0 && u < image.cols && v < image.rows) out.at<T>(y, x) = image.at<T>(v, u);
    }
  }
}

cv::Mat gathered(const cv::Mat& image, const cv::Mat& pixels, double none) {
  cv::Mat out(pixels.size(), image.type(), cv::Scalar::all(none));
  switch (image.elemSize()) {
    case 1:
      gather<uchar>(image, pixels, out);
      break;
    case 2:
      gather<ushort>(image, pixels, out);
      break;
    case 3:
      gather<cv::Vec3b>(image, pixels, out);
      break;
    case 4:
      gather<float>(image, pixels, out);
      break;
    default:
      CV_Error(cv::Error::StsUnsupportedFormat, "to_color, to_depth: pixels of 1 to 4 bytes");
  }
  return out;
}

}  // namespace

cv::Mat corrected_depth_mm(const cv::Mat& raw_depth_mm, const SensorCalibration& sensor) {
  cv::Mat depth(raw_depth_mm.size(), CV_32F, cv::Scalar(0));
  const float offset_mm = static_cast<float>(1000 * sensor.depth_offset_m);
  for (int y = 0; y < depth.rows; ++y)
    for (int x = 0; x < depth.cols; ++x)
      if (const auto raw = raw_depth_mm.at<ushort>(y, x)) depth.at<float>(y, x) = std::max(0.f, raw - offset_mm);
  return depth;
}

cv::Mat pixel_rays(const Camera& camera) {
  cv::Mat rays(camera.height, camera.width, CV_32FC2);
  for (int y = 0; y < rays.rows; ++y) {
    for (int x = 0; x < rays.cols; ++x) {
      const Vector2d ray = camera.normalized(Vector2d(x, y));
      rays.at<cv::Vec2f>(y, x) = {static_cast<float>(ray.x()), static_cast<float>(ray.y())};
    }
  }
  return rays;
}

cv::Mat depth_points_m(const cv::Mat& depth_mm, const Camera& ir) {
  cv::Mat points(depth_mm.size(), CV_32FC3, cv::Scalar::all(kNaN));
  for (int y = 0; y < points.rows; ++y) {
    for (int x = 0; x < points.cols; ++x) {
      const float depth = depth_mm.at<float>(y, x);
      if (!(depth > 0)) continue;
      const Vector2d ray = ir.normalized(Vector2d(x, y));
      const float z = depth / 1000;
      points.at<cv::Vec3f>(y, x) = {static_cast<float>(ray.x()) * z, static_cast<float>(ray.y()) * z, z};
    }
  }
  return points;
}

ColorDepthMap color_depth_map(const cv::Mat& depth_mm, const SensorCalibration& sensor, double max_jump_mm) {
  require_color(sensor);
  const cv::Size size(sensor.color->width, sensor.color->height);
  ColorDepthMap map{cv::Mat(size, CV_32FC2, cv::Scalar::all(kNaN)), cv::Mat::zeros(size, CV_32F),
                    cv::Mat::zeros(size, CV_32F)};
  const auto corners = corners_of(depth_mm, sensor);
  for (int y = 0; y + 1 < depth_mm.rows; ++y) {
    for (int x = 0; x + 1 < depth_mm.cols; ++x) {
      const Corner* a = &corners[static_cast<std::size_t>(y) * depth_mm.cols + x];
      const Corner *b = a + 1, *c = a + depth_mm.cols, *d = c + 1;
      const bool abc = joined(*a, *b, *c, max_jump_mm), bdc = joined(*b, *d, *c, max_jump_mm);
      if (abc) rasterize(*a, *b, *c, map);
      if (bdc) rasterize(*b, *d, *c, map);
      if (abc || bdc) continue;  // with one corner missing, the other diagonal may still give a triangle
      if (joined(*a, *b, *d, max_jump_mm)) rasterize(*a, *b, *d, map);
      if (joined(*a, *d, *c, max_jump_mm)) rasterize(*a, *d, *c, map);
    }
  }
  return map;
}

cv::Mat color_of_depth_pixels(const cv::Mat& depth_mm, const SensorCalibration& sensor, const ColorDepthMap* map,
                              double ghost_mm) {
  require_color(sensor);
  cv::Mat pixels(depth_mm.size(), CV_32FC2, cv::Scalar::all(kNaN));
  for (const Corner& corner : corners_of(depth_mm, sensor)) {
    if (std::isnan(corner.u) || !sensor.color->contains(Vector2d(corner.u, corner.v))) continue;
    if (map) {
      const float nearest = map->z_mm.at<float>(std::clamp(cvRound(corner.v), 0, map->z_mm.rows - 1),
                                                std::clamp(cvRound(corner.u), 0, map->z_mm.cols - 1));
      if (nearest > 0 && corner.z_mm > nearest + ghost_mm) continue;
    }
    pixels.at<cv::Vec2f>(static_cast<int>(corner.y), static_cast<int>(corner.x)) = {corner.u, corner.v};
  }
  return pixels;
}

cv::Mat to_color(const cv::Mat& image, const ColorDepthMap& map, double none) {
  return gathered(image, map.depth_pixel, none);
}

cv::Mat to_depth(const cv::Mat& image, const cv::Mat& color_pixels, double none) {
  return gathered(image, color_pixels, none);
}

}  // namespace dressform
