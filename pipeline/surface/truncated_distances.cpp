#include "pipeline/surface/truncated_distances.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace dressform {
namespace {

constexpr double kNearest_m = 0.1;  // from the sensor: nothing is measured nearer

// Depth between the pixels where the four about it are one surface, else of the nearest; 0 for none.
float depth_between(const cv::Mat& depth_mm, const Vector2d& pixel, double jump_mm) {
  const int x = static_cast<int>(std::floor(pixel.x())), y = static_cast<int>(std::floor(pixel.y()));
  const float a = depth_mm.at<float>(y, x), b = depth_mm.at<float>(y, x + 1);
  const float c = depth_mm.at<float>(y + 1, x), d = depth_mm.at<float>(y + 1, x + 1);
  const float low = std::min({a, b, c, d}), high = std::max({a, b, c, d});
  const auto u = static_cast<float>(pixel.x() - x), v = static_cast<float>(pixel.y() - y);
  if (low > 0 && high - low < static_cast<float>(jump_mm))
    return (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d);
  return depth_mm.at<float>(y + (v >= 0.5f), x + (u >= 0.5f));
}

Vector3d seen_point(const DepthView& view, const cv::Mat& depth_mm, int x, int y) {
  const cv::Vec2f& ray = view.rays.at<cv::Vec2f>(y, x);
  return Vector3d(ray[0], ray[1], 1) * static_cast<double>(depth_mm.at<float>(y, x));
}

float cosine_at(const DepthView& view, const cv::Mat& depth_mm, int x, int y, double jump_mm) {
  const float z = depth_mm.at<float>(y, x);
  if (z <= 0) return 0;
  for (const cv::Point step : {cv::Point(-1, 0), cv::Point(1, 0), cv::Point(0, -1), cv::Point(0, 1)}) {
    const float other = depth_mm.at<float>(y + step.y, x + step.x);
    if (other <= 0 || std::abs(other - z) > static_cast<float>(jump_mm)) return 0;
  }
  const Vector3d right = seen_point(view, depth_mm, x + 1, y) - seen_point(view, depth_mm, x - 1, y);
  const Vector3d down = seen_point(view, depth_mm, x, y + 1) - seen_point(view, depth_mm, x, y - 1);
  const Vector3d normal = right.cross(down).normalized();
  return static_cast<float>(std::abs(normal.dot(seen_point(view, depth_mm, x, y).normalized())));
}

}  // namespace

ClothDepth cloth_depth(const DepthView& view, const cv::Mat& depth_mm, const TruncationParams& params) {
  ClothDepth cloth;
  cloth.view = &view;
  cloth.depth_mm = depth_mm.clone();
  // Pixels without cloth have depth 0, metres from any cloth: the filter's range leaves them out.
  if (params.range_mm > 0 && params.space_px > 0) {
    const int window = 2 * static_cast<int>(std::ceil(2 * params.space_px)) + 1;
    cv::bilateralFilter(depth_mm, cloth.depth_mm, window, params.range_mm, params.space_px);
    cloth.depth_mm.setTo(0, depth_mm <= 0);
  }
  cloth.weight = cv::Mat(depth_mm.size(), CV_32F, cv::Scalar(0));
  for (int y = 1; y + 1 < depth_mm.rows; ++y)
    for (int x = 1; x + 1 < depth_mm.cols; ++x)
      cloth.weight.at<float>(y, x) = cosine_at(view, cloth.depth_mm, x, y, params.jump_mm);
  return cloth;
}

std::vector<float> truncated_distances(const Lattice& lattice, const std::vector<ClothDepth>& cloth,
                                       const TruncationParams& params) {
  const auto far = static_cast<float>(params.truncation_m);
  const auto distance_at = [&](const Vector3d& point) {
    double sum = 0, weights = 0;
    bool behind = false;
    for (const ClothDepth& each : cloth) {
      const Vector3d p = each.view->sensor_from_model * point;
      if (p.z() < kNearest_m) continue;
      const Vector2d pixel = each.view->sensor->ir.project(p);
      const bool in_image =
          pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < each.depth_mm.cols - 1 && pixel.y() < each.depth_mm.rows - 1;
      if (!in_image) continue;
      const int x = static_cast<int>(std::lround(pixel.x())), y = static_cast<int>(std::lround(pixel.y()));
      if (each.view->depth_mm.at<float>(y, x) / 1000.0 - p.z() > params.see_through_m) return far;
      const float z_mm = depth_between(each.depth_mm, pixel, params.jump_mm);
      if (z_mm <= 0) continue;
      const double distance = z_mm / 1000.0 - p.z();
      const double weight = each.weight.at<float>(y, x);
      behind = behind || distance < -params.truncation_m;
      if (distance < -params.truncation_m || weight <= 0) continue;
      sum += weight * std::min(distance, params.truncation_m);
      weights += weight;
    }
    if (weights > 0) return static_cast<float>(sum / weights);
    return behind ? -far : far;
  };
  std::vector<float> field(lattice.count());
  tbb::parallel_for(std::size_t{0}, field.size(), [&](std::size_t i) { field[i] = distance_at(lattice.point(i)); });
  return field;
}

}  // namespace dressform
