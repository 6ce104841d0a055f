#include "pipeline/surface/leg_tube.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace dressform {
namespace {

constexpr int kTubeSides = 72;
constexpr double kTubeStep_m = 0.02;
constexpr double kLeastRadius_m = 0.01;  // of a hull seen from its centre
constexpr int kSmoothed = 2;             // levels to either side, over which the radii are averaged

// The hull of what the section of legs and torso shows at one height, as distances from a centre in all directions.
struct HullLevel {
  double y = 0;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  std::vector<double> radius;
};

std::vector<cv::Point2f> hull_at(const std::vector<Vector3d>& points, double y) {
  std::vector<cv::Point2f> flat, hull;
  for (const Vector3d& p : points)
    if (std::abs(p.y() - y) < kTubeStep_m / 2) flat.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.z()));
  if (flat.size() >= 3) cv::convexHull(flat, hull);
  return hull;
}

HullLevel radial(const std::vector<cv::Point2f>& hull, double y) {
  HullLevel level;
  level.y = y;
  cv::Point2f low = hull[0], high = hull[0];
  for (const auto& p : hull) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  level.centre = {(low.x + high.x) / 2, (low.y + high.y) / 2};
  for (int k = 0; k < kTubeSides; ++k) {
    const double angle = 2 * M_PI * k / kTubeSides;
    const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
    double farthest = kLeastRadius_m;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const auto &p = hull[i], &q = hull[(i + 1) % hull.size()];
      const Eigen::Vector2d a = Eigen::Vector2d(p.x, p.y) - level.centre, e = Eigen::Vector2d(q.x - p.x, q.y - p.y);
      const double det = ray.x() * -e.y() + ray.y() * e.x();
      if (std::abs(det) < 1e-12) continue;
      const double t = (a.x() * -e.y() + a.y() * e.x()) / det, s = (ray.x() * a.y() - ray.y() * a.x()) / det;
      if (s >= -1e-6 && s <= 1 + 1e-6) farthest = std::max(farthest, t);
    }
    level.radius.push_back(farthest);
  }
  return level;
}

std::vector<HullLevel> hull_levels(const Mesh& body, const Landmarks& landmarks, double bottom_y) {
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < body.triangles.size(); ++i) {
    const BodyPart part = landmarks.triangle_parts[i];
    if (!is_leg(part) && part != BodyPart::torso) continue;
    for (int k = 0; k < 3; ++k) points.push_back(body.vertices[body.triangles[i][k]]);
  }
  std::vector<HullLevel> levels;
  for (double y = landmarks.crotch_y + kTubeAboveCrotch_m; y > bottom_y; y -= kTubeStep_m) {
    const auto hull = hull_at(points, y);
    if (hull.size() >= 3) levels.push_back(radial(hull, y));
  }
  return levels;
}

void add_rings(const std::vector<HullLevel>& levels, Mesh& tube) {
  const int count = static_cast<int>(levels.size());
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < kTubeSides; ++k) {
      double radius = 0;
      int used = 0;
      for (int j = std::max(0, i - kSmoothed); j <= std::min(count - 1, i + kSmoothed); ++j, ++used)
        radius += levels[j].radius[k];
      const double angle = 2 * M_PI * k / kTubeSides;
      const Eigen::Vector2d at = levels[i].centre + radius / used * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      tube.vertices.emplace_back(at.x(), levels[i].y, at.y());
    }
  for (int i = 0; i + 1 < count; ++i)
    for (int k = 0; k < kTubeSides; ++k) {
      const int a = i * kTubeSides + k, b = i * kTubeSides + (k + 1) % kTubeSides;
      tube.triangles.emplace_back(a, b, b + kTubeSides);
      tube.triangles.emplace_back(a, b + kTubeSides, a + kTubeSides);
    }
}

void close_ends(const std::vector<HullLevel>& levels, Mesh& tube) {
  const int count = static_cast<int>(levels.size());
  for (const int end : {0, count - 1}) {
    const int middle = static_cast<int>(tube.vertices.size());
    tube.vertices.emplace_back(levels[end].centre.x(), levels[end].y, levels[end].centre.y());
    for (int k = 0; k < kTubeSides; ++k) {
      const int a = end * kTubeSides + k, b = end * kTubeSides + (k + 1) % kTubeSides;
      tube.triangles.push_back(end == 0 ? Vector3i(middle, b, a) : Vector3i(middle, a, b));
    }
  }
}

}  // namespace

Mesh leg_tube(const Mesh& body, const Landmarks& landmarks, double bottom_y) {
  const auto levels = hull_levels(body, landmarks, bottom_y);
  Mesh tube;
  if (levels.size() < 2) return tube;
  add_rings(levels, tube);
  close_ends(levels, tube);
  return tube;
}

}  // namespace dressform
