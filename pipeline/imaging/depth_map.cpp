#include "pipeline/imaging/depth_map.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "pipeline/imaging/sensor_noise.h"
#include "scenes/error.h"

namespace dressform {
namespace {

// Largest ideal radius up to which the radial polynomial grows, and not more than the image's corners need.
double usable_radius_squared(const Camera& camera) {
  double corner = 0;
  for (const double u : {-0.5, camera.width - 0.5})
    for (const double v : {-0.5, camera.height - 0.5})
      corner = std::max(corner, camera.normalized({u, v}).squaredNorm());
  constexpr double kBeyondCorner = 1.2;  // of the squared radius: nothing farther out falls into the image
  const double limit = kBeyondCorner * corner;
  const auto& d = camera.distortion;
  constexpr int kSteps = 200;
  for (int i = 1; i <= kSteps; ++i) {
    const double s = limit * i / kSteps;
    if (1 + s * (3 * d[0] + s * (5 * d[1] + s * 7 * d[4])) <= 0) return limit * (i - 1) / kSteps;
  }
  return limit;
}

constexpr double kEdgeSigmas = 4;  // of noise between two pixels of one surface

struct Edges {
  double step_per_depth;  // largest step between neighbours of one surface, per metre of depth
  double sigmas;          // of the usual noise that such a step may be larger

  Edges(const Camera& camera, const DepthMapOptions& options)
      : step_per_depth(std::tan(options.edge_angle_deg * M_PI / 180) / std::min(camera.fx, camera.fy)),
        sigmas(kEdgeSigmas * options.noise_factor) {}
  bool between(float a, float b, double distance_px) const {
    const double near = std::min(a, b);
    return std::abs(a - b) > distance_px * step_per_depth * near + sigmas * axial_noise_m(near, 1);
  }
};

cv::Mat metres(const cv::Mat& depth_mm, double offset_m, const DepthMapOptions& options) {
  cv::Mat result(depth_mm.size(), CV_32F, cv::Scalar(0));
  for (int y = 0; y < depth_mm.rows; ++y) {
    const auto* in = depth_mm.ptr<std::uint16_t>(y);
    auto* out = result.ptr<float>(y);
    for (int x = 0; x < depth_mm.cols; ++x) {
      const double z = 1e-3 * in[x] - offset_m;
      if (in[x] != 0 && z >= options.min_depth_m && z <= options.max_depth_m) out[x] = static_cast<float>(z);
    }
  }
  return result;
}

bool beside_edge(const cv::Mat& depth_m, int x, int y, const Edges& edges) {
  const float z = depth_m.at<float>(y, x);
  int empty = 0;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      if (dx == 0 && dy == 0) continue;
      const int u = x + dx, v = y + dy;
      if (u < 0 || v < 0 || u >= depth_m.cols || v >= depth_m.rows) continue;
      const float other = depth_m.at<float>(v, u);
      if (other == 0)
        ++empty;
      else if (edges.between(z, other, dx != 0 && dy != 0 ? M_SQRT2 : 1.0))
        return true;
    }
  constexpr int kMostEmpty = 2;  // of the eight neighbours: holes of single pixels are no edge
  return empty > kMostEmpty;
}

// Mean over shrink x shrink pixels that hold one surface, else 0.
cv::Mat shrunken(const cv::Mat& depth_m, int shrink, const Edges& edges) {
  cv::Mat result(depth_m.rows / shrink, depth_m.cols / shrink, CV_32F, cv::Scalar(0));
  for (int y = 0; y < result.rows; ++y)
    for (int x = 0; x < result.cols; ++x) {
      float low = 0, high = 0, sum = 0;
      int count = 0;
      for (int v = y * shrink; v < (y + 1) * shrink; ++v)
        for (int u = x * shrink; u < (x + 1) * shrink; ++u) {
          const float z = depth_m.at<float>(v, u);
          if (z == 0) continue;
          low = count ? std::min(low, z) : z;
          high = count ? std::max(high, z) : z;
          sum += z;
          ++count;
        }
      if (count == shrink * shrink && !edges.between(low, high, M_SQRT2 * (shrink - 1)))
        result.at<float>(y, x) = sum / count;
    }
  return result;
}

// Normal of the plane through the 5 x 5 neighbourhood, towards the sensor; zero when there are too few neighbours.
Vector3f fitted_normal(const cv::Mat& depth_m, const cv::Mat& rays, int x, int y, const Edges& edges) {
  constexpr int kReach = 2, kEnough = 9;
  constexpr double kGauss[] = {1, 0.61, 0.14};  // of one pixel: a wider fit flattens limbs
  int count = 0;
  const float z = depth_m.at<float>(y, x);
  const cv::Vec2d& centre = rays.at<cv::Vec2d>(y, x);
  double n = 0, sx = 0, sy = 0, sw = 0, sxx = 0, sxy = 0, syy = 0, sxw = 0, syw = 0;
  for (int v = std::max(0, y - kReach); v <= std::min(depth_m.rows - 1, y + kReach); ++v)
    for (int u = std::max(0, x - kReach); u <= std::min(depth_m.cols - 1, x + kReach); ++u) {
      const float other = depth_m.at<float>(v, u);
      if (other == 0) continue;
      if (edges.between(z, other, std::max({std::abs(u - x), std::abs(v - y), 1}))) continue;
      const cv::Vec2d& ray = rays.at<cv::Vec2d>(v, u);
      const double dx = ray[0] - centre[0], dy = ray[1] - centre[1], w = 1.0 / other;
      const double g = kGauss[std::abs(u - x)] * kGauss[std::abs(v - y)];
      ++count;
      n += g, sx += g * dx, sy += g * dy, sw += g * w;
      sxx += g * dx * dx, sxy += g * dx * dy, syy += g * dy * dy, sxw += g * dx * w, syw += g * dy * w;
    }
  if (count < kEnough) return Vector3f::Zero();
  const double cxx = sxx - sx * sx / n, cxy = sxy - sx * sy / n, cyy = syy - sy * sy / n;
  const double cxw = sxw - sx * sw / n, cyw = syw - sy * sw / n, determinant = cxx * cyy - cxy * cxy;
  if (determinant <= 1e-6 * cxx * cyy) return Vector3f::Zero();
  const double a = (cyy * cxw - cxy * cyw) / determinant, b = (cxx * cyw - cxy * cxw) / determinant;
  const double c = sw / n - a * sx / n - b * sy / n;  // 1/z = a (x - x0) + b (y - y0) + c
  const Eigen::Vector3d plane(a, b, c - a * centre[0] - b * centre[1]);
  return (-plane.normalized()).cast<float>();
}

}  // namespace

Projector::Projector(const Camera& camera)
    : fx_(static_cast<float>(camera.fx)),
      fy_(static_cast<float>(camera.fy)),
      cx_(static_cast<float>(camera.cx)),
      cy_(static_cast<float>(camera.cy)),
      k1_(static_cast<float>(camera.distortion[0])),
      k2_(static_cast<float>(camera.distortion[1])),
      p1_(static_cast<float>(camera.distortion[2])),
      p2_(static_cast<float>(camera.distortion[3])),
      k3_(static_cast<float>(camera.distortion[4])),
      width_(static_cast<float>(camera.width)),
      height_(static_cast<float>(camera.height)),
      largest_radius_squared_(static_cast<float>(usable_radius_squared(camera))) {}

Camera shrunken_camera(const Camera& camera, int shrink) {
  Camera result = camera;
  result.width = camera.width / shrink;
  result.height = camera.height / shrink;
  result.fx = camera.fx / shrink;
  result.fy = camera.fy / shrink;
  result.cx = (camera.cx + 0.5) / shrink - 0.5;
  result.cy = (camera.cy + 0.5) / shrink - 0.5;
  return result;
}

cv::Mat clean_depth(const cv::Mat& depth_mm, const SensorCalibration& calibration, const DepthMapOptions& options) {
  if (depth_mm.type() != CV_16U || depth_mm.cols != calibration.ir.width || depth_mm.rows != calibration.ir.height)
    throw InputError("depth image", "found another size or type than the calibration's; expected " +
                                        std::to_string(calibration.ir.width) + " x " +
                                        std::to_string(calibration.ir.height) + ", 16 bit");
  const cv::Mat all = metres(depth_mm, calibration.depth_offset_m, options);
  const Edges edges(calibration.ir, options);
  cv::Mat result = all.clone();
  for (int y = 0; y < all.rows; ++y)
    for (int x = 0; x < all.cols; ++x)
      if (all.at<float>(y, x) > 0 && beside_edge(all, x, y, edges)) result.at<float>(y, x) = 0;
  return result;
}

DepthMap make_depth_map(const cv::Mat& depth_m, const Camera& camera, const cv::Mat& rays,
                        const DepthMapOptions& options) {
  const int shrink = std::max(1, options.shrink);
  DepthMap map;
  map.camera = shrunken_camera(camera, shrink);
  const Edges edges(map.camera, options);
  const cv::Mat small = shrink == 1 ? depth_m : shrunken(depth_m, shrink, Edges(camera, options));
  const int width = small.cols, height = small.rows;
  map.points.assign(static_cast<std::size_t>(width) * height, Vector3f::Zero());
  map.normals.assign(map.points.size(), Vector3f::Zero());
  map.sigma_m.assign(map.points.size(), 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float z = small.at<float>(y, x);
      if (z == 0) continue;
      const int index = y * width + x;
      const cv::Vec2d& ray = rays.at<cv::Vec2d>(y, x);
      const Vector3f direction(static_cast<float>(ray[0]), static_cast<float>(ray[1]), 1.0f);
      map.points[index] = direction * z;
      const Vector3f normal = fitted_normal(small, rays, x, y, edges);
      const float along = -normal.dot(direction), cosine = along / direction.norm();
      if (cosine < options.min_cosine) continue;
      map.normals[index] = normal;
      map.sigma_m[index] = static_cast<float>(options.noise_factor * axial_noise_m(z, cosine)) * along / shrink;
      ++map.valid;
    }
  return map;
}

std::vector<float> middle_depths_m(const DepthMap& map) {
  std::vector<float> depths;
  for (int y = map.camera.height / 4; y < map.camera.height * 3 / 4; ++y)
    for (int x = map.camera.width * 2 / 5; x < map.camera.width * 3 / 5; ++x) {
      const float z = map.points[static_cast<std::size_t>(y) * map.camera.width + x].z();
      if (z > 0) depths.push_back(z);
    }
  return depths;
}

DepthMap make_depth_map(const cv::Mat& depth_mm, const SensorCalibration& calibration, const DepthMapOptions& options) {
  const Camera camera = shrunken_camera(calibration.ir, std::max(1, options.shrink));
  return make_depth_map(clean_depth(depth_mm, calibration, options), calibration.ir, normalized_grid(camera), options);
}

}  // namespace dressform
