#include "scenes/camera.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

using Matrix2d = Eigen::Matrix2d;

struct Distorted {
  Vector2d point;
  Matrix2d jacobian;  // d point / d ideal
};

Vector2d distorted(const std::array<double, 5>& d, const Vector2d& ideal) {
  const double x = ideal.x(), y = ideal.y(), s = x * x + y * y;
  const double radial = 1 + s * (d[0] + s * (d[1] + s * d[4]));
  return {x * radial + 2 * d[2] * x * y + d[3] * (s + 2 * x * x),
          y * radial + d[2] * (s + 2 * y * y) + 2 * d[3] * x * y};
}

Distorted distorted_with_jacobian(const std::array<double, 5>& d, const Vector2d& ideal) {
  const double x = ideal.x(), y = ideal.y(), s = x * x + y * y;
  const double radial = 1 + s * (d[0] + s * (d[1] + s * d[4]));
  const double slope = 2 * (d[0] + s * (2 * d[1] + s * 3 * d[4]));  // d radial / d x = slope * x
  Distorted result;
  result.point = distorted(d, ideal);
  const double cross = slope * x * y + 2 * d[2] * x + 2 * d[3] * y;
  result.jacobian << radial + slope * x * x + 2 * d[2] * y + 6 * d[3] * x, cross, cross,
      radial + slope * y * y + 6 * d[2] * y + 2 * d[3] * x;
  return result;
}

// Whether the radial polynomial r (1 + k1 r^2 + k2 r^4 + k3 r^6) has turned back anywhere between 0 and r.
bool beyond_fold(const std::array<double, 5>& d, double r_squared) {
  const double a = 3 * d[0], b = 5 * d[1], c = 7 * d[4];  // derivative in s = r^2: 1 + a s + b s^2 + c s^3
  const auto slope = [&](double s) { return 1 + s * (a + s * (b + s * c)); };
  if (slope(r_squared) <= 0) return true;
  const double discriminant = b * b - 3 * a * c;
  if (c == 0 || discriminant <= 0) return false;
  const double lowest = (-b + std::sqrt(discriminant)) / (3 * c);  // the derivative's local minimum
  return lowest > 0 && lowest < r_squared && slope(lowest) <= 0;
}

// Newton's method with step halving on |distorted(ideal) - target|.
Vector2d undistorted(const std::array<double, 5>& d, const Vector2d& target) {
  constexpr int kIterations = 50, kHalvings = 30;
  Vector2d ideal = target;
  if (beyond_fold(d, ideal.squaredNorm())) ideal = Vector2d::Zero();
  Distorted at = distorted_with_jacobian(d, ideal);
  double error = (at.point - target).squaredNorm();
  for (int i = 0; i < kIterations && error > 1e-26; ++i) {
    // Slightly regularised, so that a singular Jacobian on the fold still gives a step downhill.
    const Matrix2d normal = at.jacobian.transpose() * at.jacobian + 1e-14 * Matrix2d::Identity();
    const Vector2d step = normal.inverse() * (at.jacobian.transpose() * (target - at.point));
    double length = 1;
    bool better = false;
    for (int k = 0; k < kHalvings && !better; ++k, length /= 2) {
      const Vector2d trial = ideal + length * step;
      if (beyond_fold(d, trial.squaredNorm())) continue;
      const double trial_error = (distorted(d, trial) - target).squaredNorm();
      if (trial_error >= error) continue;
      ideal = trial;
      error = trial_error;
      better = true;
    }
    if (!better) break;
    at = distorted_with_jacobian(d, ideal);
  }
  return ideal;
}

bool has_distortion(const std::array<double, 5>& d) {
  return std::any_of(d.begin(), d.end(), [](double k) { return k != 0; });
}

}  // namespace

Vector2d Camera::project(const Vector3d& point_in_camera) const {
  Vector2d ideal = point_in_camera.head<2>() / point_in_camera.z();
  if (has_distortion(distortion) && !beyond_fold(distortion, ideal.squaredNorm())) ideal = distorted(distortion, ideal);
  return {fx * ideal.x() + cx, fy * ideal.y() + cy};
}

Vector2d Camera::normalized(const Vector2d& pixel) const {
  const Vector2d target((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  return has_distortion(distortion) ? undistorted(distortion, target) : target;
}

Vector3d Camera::unproject(const Vector2d& pixel, double depth_m) const {
  const Vector2d ideal = normalized(pixel);
  return {ideal.x() * depth_m, ideal.y() * depth_m, depth_m};
}

Camera Camera::scaled(double scale) const {
  Camera result = *this;
  result.width = std::max(1, static_cast<int>(std::lround(width * scale)));
  result.height = std::max(1, static_cast<int>(std::lround(height * scale)));
  const double scale_x = static_cast<double>(result.width) / width;
  const double scale_y = static_cast<double>(result.height) / height;
  result.fx = fx * scale_x;
  result.fy = fy * scale_y;
  result.cx = (cx + 0.5) * scale_x - 0.5;  // the image's corner is at -0.5 in both
  result.cy = (cy + 0.5) * scale_y - 0.5;
  return result;
}

cv::Mat normalized_grid(const Camera& camera) {
  cv::Mat grid(camera.height, camera.width, CV_64FC2);
  tbb::parallel_for(tbb::blocked_range<int>(0, camera.height), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y < rows.end(); ++y) {
      cv::Vec2d* row = grid.ptr<cv::Vec2d>(y);
      for (int x = 0; x < camera.width; ++x) {
        const Vector2d ideal = camera.normalized({x, y});
        row[x] = {ideal.x(), ideal.y()};
      }
    }
  });
  return grid;
}

}  // namespace dressform
