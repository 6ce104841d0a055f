#include "pipeline/fit/ease.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace dressform {
namespace {

constexpr int kLevels = 90;         // over the trunk
constexpr double kLastPart = 2.94;  // just below the armpits: above, the trunk's section takes in the arms
constexpr double kFade_m = 0.015;

// Where the garment's triangles of the trunk cross the height, (x, z).
std::vector<cv::Point2f> crossings(const Mesh& garment, const std::vector<double>& weights, double y) {
  std::vector<cv::Point2f> points;
  for (const auto& t : garment.triangles) {
    if (weights[t[0]] < 0.5 || weights[t[1]] < 0.5 || weights[t[2]] < 0.5) continue;
    for (int k = 0; k < 3; ++k) {
      const Vector3d &a = garment.vertices[t[k]], &b = garment.vertices[t[(k + 1) % 3]];
      if ((a.y() < y) == (b.y() < y)) continue;
      const Vector3d p = a + (y - a.y()) / (b.y() - a.y()) * (b - a);
      points.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.z()));
    }
  }
  return points;
}

bool goes_round(const std::vector<cv::Point2f>& points, const Vector3d& centre) {
  constexpr int kSectors = 36;
  int seen[kSectors] = {};
  for (const auto& p : points) {
    const double angle = std::atan2(p.y - centre.z(), p.x - centre.x()) / (2 * M_PI) + 1;
    ++seen[static_cast<int>(angle * kSectors) % kSectors];
  }
  return std::count_if(seen, seen + kSectors, [](int n) { return n > 0; }) >= 30;
}

// Tape girth of cloth minus body at height y, m; nothing where the cloth does not go round.
std::optional<double> ease_at(const Mesh& garment, const std::vector<double>& weights, const StandingBody& body,
                              double y) {
  const SectionLoop* loop = body.trunk_loop(y);
  if (!loop) return {};
  const auto points = crossings(garment, weights, body.sections.y(body.sections.level(y)));
  if (points.size() < 20 || !goes_round(points, loop->centroid)) return {};
  std::vector<cv::Point2f> hull;
  cv::convexHull(points, hull);
  return cv::arcLength(hull, true) - tape_girth(*loop);
}

}  // namespace

double trunk_height(const StandingBody& body, double t) {
  const double marks[] = {body.crotch_y, body.hip_y,  body.waist_y,
                          body.armpit_y, body.neck_y, body.limbs.floor_y + body.stature};
  const int i = std::clamp(static_cast<int>(t), 0, 4);
  return marks[i] + (t - i) * (marks[i + 1] - marks[i]);
}

std::vector<Vector3d> with_ease_kept(const Mesh& before, const StandingBody& naked, const Mesh& fitted,
                                     const StandingBody& user, const std::vector<double>& weights, double largest_m) {
  std::vector<std::pair<double, double>> wanted;  // height on the user, change of radius
  for (int level = 0; level < kLevels; ++level) {
    const double t = kLastPart * (level + 0.5) / kLevels;
    const auto was = ease_at(before, weights, naked, trunk_height(naked, t));
    const auto is = ease_at(fitted, weights, user, trunk_height(user, t));
    if (was && is)
      wanted.emplace_back(trunk_height(user, t), std::clamp((*was - *is) / (2 * M_PI), -largest_m, largest_m));
  }
  const auto change_at = [&](double y) {
    double sum = 0, total = 1e-3;  // a little weight for "no change", which wins away from the measured levels
    for (const auto& [height, change] : wanted) {
      const double d = (height - y) / kFade_m, weight = std::exp(-0.5 * d * d);
      sum += weight * change;
      total += weight;
    }
    return sum / total;
  };
  std::vector<Vector3d> result = fitted.vertices;
  if (wanted.empty()) return result;
  for (std::size_t v = 0; v < result.size(); ++v) {
    const SectionLoop* loop = user.trunk_loop(result[v].y());
    Vector3d out = loop ? Vector3d(result[v] - loop->centroid) : Vector3d::Zero();
    out.y() = 0;
    if (weights[v] > 0 && out.norm() > 0.03) result[v] += weights[v] * change_at(result[v].y()) * out.normalized();
  }
  return result;
}

}  // namespace dressform
