#include "pipeline/surface/leg_hulls.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace dressform {
namespace {

constexpr double kStep_m = 0.02;         // between levels
constexpr double kBody_m = 0.010;        // half the height of the leg's slices
constexpr double kCloth_m = 0.015;       // and of the cloth's: a pixel row at least
constexpr std::size_t kFewest = 8;       // points of cloth
constexpr double kBelowCrotch_m = 0.03;  // above, the legs share the cloth
constexpr double kBlend_m = 0.06;        // of height over which the hulls come to hold
constexpr double kLoose_m = 0.15;        // beyond a hull where it does not hold
constexpr double kFacing = 0.5;          // cosine to the way to the other leg from which a hull holds in full
constexpr double kWithin = -1;           // metres: no limit

Eigen::Vector2d flat(const Vector3d& p) { return {p.x(), p.z()}; }

}  // namespace

LegHulls::LegHulls(const PointCloud& cloth, const Mesh& body, const Landmarks& limbs, const GarmentLayout& layout,
                   double margin_m) {
  if (!layout.forked() || !limbs.left_leg || !limbs.right_leg) return;
  known_ = true;
  top_y_ = limbs.crotch_y - kBelowCrotch_m;
  middle_ = limbs.hips();
  left_ = limbs.left;
  for (int side = 0; side < 2; ++side)
    legs_[side] = make_leg(side, cloth, body, limbs, layout.legs[side].end_y - margin_m);
}

LegHulls::Leg LegHulls::make_leg(int side, const PointCloud& cloth, const Mesh& body, const Landmarks& limbs,
                                 double bottom_y) const {
  const int levels = std::max(0, static_cast<int>(std::ceil((top_y_ - bottom_y) / kStep_m)) + 1);
  std::vector<std::vector<cv::Point2f>> slices(levels);
  std::vector<std::size_t> cloth_points(levels, 0);
  const auto add = [&](const Vector3d& p, double half, bool is_cloth) {
    const int first = static_cast<int>(std::ceil((top_y_ - p.y() - half) / kStep_m));
    for (int i = std::max(0, first); i < levels && std::abs(top_y_ - i * kStep_m - p.y()) <= half; ++i) {
      slices[i].emplace_back(static_cast<float>(p.x()), static_cast<float>(p.z()));
      cloth_points[i] += is_cloth;
    }
  };
  const BodyPart part = side == 0 ? BodyPart::left_leg : BodyPart::right_leg;
  for (std::size_t i = 0; i < body.triangles.size(); ++i)
    if (limbs.triangle_parts[i] == part)
      for (int k = 0; k < 3; ++k) add(body.vertices[body.triangles[i][k]], kBody_m, false);
  Leg leg;
  leg.centres.assign(levels, Eigen::Vector2d::Zero());
  for (int i = 0; i < levels; ++i) {
    for (const cv::Point2f& p : slices[i]) leg.centres[i] += Eigen::Vector2d(p.x, p.y) / slices[i].size();
    if (slices[i].empty()) leg.centres[i] = flat(limbs.leg(side)->root);
  }
  for (const Vector3d& p : cloth.points)
    if (((p - middle_).dot(left_) > 0) == (side == 0)) add(p, kCloth_m, true);
  leg.inwards = -flat(limbs.outwards(side));
  for (int i = 0; i < levels; ++i) {
    Hull hull;
    std::vector<cv::Point2f> corners;
    if (cloth_points[i] >= kFewest) cv::convexHull(slices[i], corners);
    for (std::size_t k = 0; k < corners.size() && corners.size() >= 3; ++k) {
      const cv::Point2f side_of = corners[(k + 1) % corners.size()] - corners[k];
      Eigen::Vector2d normal = Eigen::Vector2d(side_of.y, -side_of.x).normalized();
      const Eigen::Vector2d from(corners[k].x, corners[k].y);
      if (normal.dot(leg.centres[i] - from) > 0) normal = -normal;
      hull.push_back({normal, normal.dot(from)});
    }
    leg.hulls.push_back(std::move(hull));
  }
  return leg;
}

double LegHulls::at_level(const Leg& leg, int level, const Eigen::Vector2d& at) const {
  if (level < 0 || level >= static_cast<int>(leg.hulls.size()) || leg.hulls[level].empty()) return kWithin;
  double beyond = kWithin;
  for (const Edge& edge : leg.hulls[level]) beyond = std::max(beyond, edge.normal.dot(at) - edge.offset);
  const Eigen::Vector2d out = at - leg.centres[level];
  const double facing = out.norm() > 1e-6 ? out.dot(leg.inwards) / out.norm() : 1;
  return beyond - kLoose_m * std::clamp(1 - facing / kFacing, 0.0, 1.0);
}

double LegHulls::beyond(const Vector3d& point) const {
  if (!known_ || point.y() > top_y_) return kWithin;
  const Leg& leg = legs_[(point - middle_).dot(left_) > 0 ? 0 : 1];
  const double at = (top_y_ - point.y()) / kStep_m;
  const int level = static_cast<int>(std::floor(at));
  const double part = at - level;
  const double beyond = (1 - part) * at_level(leg, level, flat(point)) + part * at_level(leg, level + 1, flat(point));
  return beyond - kLoose_m * std::clamp(1 - (top_y_ - point.y()) / kBlend_m, 0.0, 1.0);
}

}  // namespace dressform
