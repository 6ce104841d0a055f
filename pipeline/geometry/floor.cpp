#include "pipeline/geometry/floor.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "scenes/random.h"
#include "scenes/small_solvers.h"

namespace dressform {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

// Every other pixel of every other row, and only the lower part of the image: floors lie low.
std::vector<Vector3d> candidates(const cv::Mat& points_m) {
  std::vector<Vector3d> points;
  for (int y = points_m.rows / 3; y < points_m.rows; y += 2) {
    for (int x = 0; x < points_m.cols; x += 2) {
      const auto& p = points_m.at<cv::Vec3f>(y, x);
      if (!std::isnan(p[2])) points.emplace_back(p[0], p[1], p[2]);
    }
  }
  return points;
}

std::optional<Vector4d> plane_through(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                                      const FloorSearch& search) {
  const Vector3d cross = (b - a).cross(c - a);
  if (cross.norm() < 1e-3) return {};  // too close together to say anything
  Vector3d normal = cross.normalized();
  if (normal.dot(search.up) < 0) normal = -normal;
  if (normal.dot(search.up) < std::cos(search.tilt_deg * M_PI / 180)) return {};
  return Vector4d(normal.x(), normal.y(), normal.z(), -normal.dot(a));
}

double height(const Vector4d& plane, const Vector3d& p) { return plane.head<3>().dot(p) + plane[3]; }

// Inliers less what lies below: a table top has the floor under it, the floor has nothing.
int support(const Vector4d& plane, const std::vector<Vector3d>& points, double tolerance_m) {
  int on = 0, below = 0;
  for (const Vector3d& p : points) {
    const double h = height(plane, p);
    on += std::abs(h) < tolerance_m;
    below += h < -4 * tolerance_m;
  }
  return on - 2 * below;
}

std::vector<Vector3d> inliers(const Vector4d& plane, const std::vector<Vector3d>& points, double tolerance_m) {
  std::vector<Vector3d> result;
  for (const Vector3d& p : points)
    if (std::abs(height(plane, p)) < tolerance_m) result.push_back(p);
  return result;
}

}  // namespace

Vector4d fit_plane(const std::vector<Vector3d>& points) {
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Vector3d& p : points) covariance += (p - mean) * (p - mean).transpose();
  const Vector3d normal = symmetric_eigen(covariance).vectors.col(0);
  return Vector4d(normal.x(), normal.y(), normal.z(), -normal.dot(mean));
}

std::optional<Vector4d> find_floor(const cv::Mat& points_m, const FloorSearch& search, Seed seed,
                                   std::uint64_t stream) {
  FloorSearch quarter = search;
  quarter.least_inliers /= 4;
  return find_floor(candidates(points_m), quarter, seed, stream);
}

std::optional<Vector4d> find_floor(const std::vector<Vector3d>& points, const FloorSearch& search, Seed seed,
                                   std::uint64_t stream) {
  if (points.size() < 3) return {};
  std::optional<Vector4d> best;
  int best_support = search.least_inliers;
  for (int draw = 0; draw < search.draws; ++draw) {
    const auto random = uniform4(seed, stream, static_cast<std::uint64_t>(draw));
    const auto pick = [&](int k) -> const Vector3d& {
      return points[std::min(points.size() - 1, static_cast<std::size_t>(random[k] * points.size()))];
    };
    const auto plane = plane_through(pick(0), pick(1), pick(2), search);
    if (!plane) continue;
    const int found = support(*plane, points, search.tolerance_m);
    if (found <= best_support) continue;
    best_support = found;
    best = plane;
  }
  for (int pass = 0; best && pass < 3; ++pass) {
    const auto kept = inliers(*best, points, search.tolerance_m);
    if (kept.size() < 3) return {};
    Vector4d plane = fit_plane(kept);
    if (plane.head<3>().dot(search.up) < 0) plane = -plane;
    best = plane;
  }
  return best;
}

}  // namespace dressform
