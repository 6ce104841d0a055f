#include "pipeline/surface/covered_body.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace dressform {
namespace {

constexpr double kEndPart = 0.0005;  // of the points (and four at least) may lie beyond an end as strays
constexpr int kTubeSides = 72;
constexpr double kTubeStep_m = 0.02;
constexpr double kForkSeam_m = 0.02;   // legs come apart this far below the crotch
constexpr double kPastCuff_m = 0.025;  // an arm comes off the trunk this far past the cuff at the latest ...
constexpr double kArmSeam_m = 0.02;    // ... and this far below the armpit at the earliest
constexpr double kBeyond_m = 0.04;     // body kept past the caps, so that the surface runs straight up to them

// The least value when a few strays are left out.
double lower_end(std::vector<double> values) {
  const std::size_t strays = std::max<std::size_t>(4, static_cast<std::size_t>(kEndPart * values.size()));
  if (values.empty()) return 0;
  const auto at = values.begin() + std::min(values.size() - 1, strays);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double upper_end(std::vector<double> values) {
  for (double& value : values) value = -value;
  return -lower_end(std::move(values));
}

// Where the sleeve ends, along the arm: the end of the points that follow one another from the shoulder. Cloth that
// hangs beside a hand is nearest to the arm, too, but bare arm lies between.
double sleeve_end(const std::vector<double>& along) {
  constexpr double kBin_m = 0.02;
  constexpr int kFewest = 3;
  std::vector<int> count;
  const auto bin_of = [](double value) { return static_cast<std::size_t>(std::max(0.0, value) / kBin_m); };
  for (const double value : along) {
    const std::size_t bin = bin_of(value);
    if (count.size() <= bin) count.resize(bin + 1, 0);
    ++count[bin];
  }
  std::size_t end = 0;
  while (end < count.size() && count[end] < kFewest) ++end;
  while (end < count.size() && (count[end] >= kFewest || (end + 1 < count.size() && count[end + 1] >= kFewest))) ++end;
  std::vector<double> sleeve;
  for (const double value : along)
    if (bin_of(value) < end) sleeve.push_back(value);
  return sleeve.size() < 20 ? 0 : upper_end(std::move(sleeve));
}

// Height of an arm's axis at Limb::along, or of its root if that is lower.
double lowest_of_arm(const Limb& arm, double along) {
  return std::min(arm.root.y(), arm.root.y() + arm.direction.y() * along);
}

// Whether the points go round each leg: between the legs, a garment round both has points in front and behind.
bool goes_round_each_leg(const std::vector<Vector3d>& points, const BodyLimbs& limbs, double bottom_y) {
  if (!limbs.left_leg || !limbs.right_leg) return false;
  const Limb &a = *limbs.left_leg, &b = *limbs.right_leg;
  constexpr double kBin_m = 0.02;
  const double top = limbs.crotch_y - 0.03;
  const int bins = static_cast<int>(std::floor((top - bottom_y) / kBin_m));
  if (bins < 1) return false;
  std::vector<int> between(bins, 0), around(bins, 0);
  for (const Vector3d& p : points) {
    const int bin = static_cast<int>(std::floor((top - p.y()) / kBin_m));
    if (bin < 0 || bin >= bins) continue;
    ++around[bin];
    const Vector3d left = a.root + a.direction * ((p.y() - a.root.y()) / a.direction.y());
    const Vector3d right = b.root + b.direction * ((p.y() - b.root.y()) / b.direction.y());
    const Vector3d from_middle = p - (left + right) / 2;
    if (std::abs(from_middle.dot(limbs.left)) < 0.012 && std::abs(from_middle.dot(limbs.front)) > 0.045) ++between[bin];
  }
  int bridged = 0, judged = 0;
  for (int bin = 0; bin < bins; ++bin) {
    if (around[bin] < 10) continue;
    ++judged;
    bridged += between[bin] >= 2;
  }
  return 2 * bridged < judged;
}

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
    double farthest = 0.01;
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

// Closed tube of the convex hulls of the legs, up to a little above the crotch.
Mesh leg_tube(const Mesh& body, const BodyLimbs& limbs, double bottom_y) {
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < body.triangles.size(); ++i) {
    const BodyPart part = limbs.triangle_parts[i];
    if (!is_leg(part) && part != BodyPart::torso) continue;
    for (int k = 0; k < 3; ++k) points.push_back(body.vertices[body.triangles[i][k]]);
  }
  std::vector<HullLevel> levels;
  const double top = limbs.crotch_y + 0.06;
  for (double y = top; y > bottom_y; y -= kTubeStep_m) {
    const auto hull = hull_at(points, y);
    if (hull.size() >= 3) levels.push_back(radial(hull, y));
  }
  Mesh tube;
  if (levels.size() < 2) return tube;
  const int count = static_cast<int>(levels.size());
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < kTubeSides; ++k) {
      double radius = 0;
      int used = 0;
      for (int j = std::max(0, i - 2); j <= std::min(count - 1, i + 2); ++j, ++used) radius += levels[j].radius[k];
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
  for (const int end : {0, count - 1}) {
    const int middle = static_cast<int>(tube.vertices.size());
    tube.vertices.emplace_back(levels[end].centre.x(), levels[end].y, levels[end].centre.y());
    for (int k = 0; k < kTubeSides; ++k) {
      const int a = end * kTubeSides + k, b = end * kTubeSides + (k + 1) % kTubeSides;
      tube.triangles.push_back(end == 0 ? Vector3i(middle, b, a) : Vector3i(middle, a, b));
    }
  }
  return tube;
}

std::vector<bool> kept_triangles(const MeshQuery& naked, const BodyLimbs& limbs, const std::string& garment,
                                 const GarmentExtent& extent, double past_m) {
  const Mesh& body = naked.mesh();
  std::vector<bool> kept(body.triangles.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const Vector3i& t = body.triangles[i];
    const Vector3d centre = (body.vertices[t[0]] + body.vertices[t[1]] + body.vertices[t[2]]) / 3;
    const BodyPart part = limbs.triangle_parts[i];
    kept[i] = centre.y() < extent.top_y + past_m;
    if (is_arm(part)) {
      const int side = part == BodyPart::left_arm ? 0 : 1;
      kept[i] =
          garment == "top" && extent.has_arm[side] && limbs.arm(side)->along(centre) < extent.arm_along[side] + past_m;
    } else if (is_leg(part) && extent.forked) {
      kept[i] = kept[i] && centre.y() > extent.leg_bottom_y[part == BodyPart::left_leg ? 0 : 1] - past_m;
    } else {
      kept[i] = kept[i] && centre.y() > extent.bottom_y - past_m;
    }
  }
  return kept;
}

Mesh only(const Mesh& mesh, const std::vector<bool>& kept) {
  Mesh part;
  part.vertices = mesh.vertices;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) part.triangles.push_back(mesh.triangles[i]);
  return compacted(part);
}

// How far down the arm points bridge it with the trunk, as cloth round the armhole does: Limb::along of the last such
// place. Below it, sleeve and trunk are two layers.
double bridged_along(const std::vector<Vector3d>& points, const MeshQuery& naked, const BodyLimbs& limbs, int side,
                     double cuff_along) {
  constexpr double kBin_m = 0.01, kMiddle_m = 0.006, kReach_m = 0.08;
  constexpr std::size_t kFewest = 3;
  const BodyPart part = side == 0 ? BodyPart::left_arm : BodyPart::right_arm;
  std::vector<bool> of_arm(limbs.triangle_parts.size()), of_rest = of_arm;
  for (std::size_t i = 0; i < of_arm.size(); ++i) of_rest[i] = !(of_arm[i] = limbs.triangle_parts[i] == part);
  const MeshQuery arm(only(naked.mesh(), of_arm)), rest(only(naked.mesh(), of_rest));
  std::vector<std::size_t> between(std::max(1, static_cast<int>(cuff_along / kBin_m) + 1), 0);
  for (const Vector3d& p : points) {
    const double along = limbs.arm(side)->along(p);
    if (along < 0 || along >= cuff_along) continue;
    const double to_arm = arm.closest(p, kReach_m).distance, to_rest = rest.closest(p, kReach_m).distance;
    if (std::isfinite(to_arm) && std::isfinite(to_rest) && std::abs(to_arm - to_rest) < 2 * kMiddle_m)
      ++between[static_cast<std::size_t>(along / kBin_m)];
  }
  std::size_t last = 0;
  while (last < between.size() && between[last] >= kFewest) ++last;
  return kBin_m * static_cast<double>(last);
}

}  // namespace

GarmentExtent garment_extent(const std::string& garment, const PointCloud& cloud, const MeshQuery& naked,
                             const BodyLimbs& limbs) {
  GarmentExtent extent;
  std::vector<double> heights, arms[2], legs[2];
  std::vector<Vector3d> around_legs;
  for (const Vector3d& p : cloud.points) {
    const BodyPart part = limbs.part_of(naked.closest(p).triangle);
    if (is_arm(part) && garment == "top") {
      const int side = part == BodyPart::left_arm ? 0 : 1;
      arms[side].push_back(limbs.arm(side)->along(p));
      continue;
    }
    heights.push_back(p.y());
    if (p.y() > limbs.crotch_y) continue;
    around_legs.push_back(p);
    const int side = (p - (limbs.left_leg ? limbs.left_leg->root : Vector3d::Zero())).dot(limbs.left) >
                             (limbs.right_leg ? (limbs.right_leg->root - p).dot(limbs.left) : 0)
                         ? 0
                         : 1;
    legs[side].push_back(p.y());
  }
  extent.top_y = upper_end(heights);
  extent.bottom_y = lower_end(heights);
  for (int side = 0; side < 2; ++side) {
    extent.has_arm[side] = limbs.arm(side) && garment == "top";
    extent.arm_along[side] = sleeve_end(arms[side]);
    extent.arm_free_along[side] = extent.arm_along[side] + kPastCuff_m;
    if (extent.has_arm[side])
      extent.arm_free_along[side] =
          std::min(extent.arm_free_along[side],
                   kArmSeam_m + bridged_along(cloud.points, naked, limbs, side, extent.arm_along[side]));
    extent.leg_bottom_y[side] = legs[side].size() < 20 ? extent.bottom_y : lower_end(legs[side]);
  }
  extent.forked = garment == "bottom" && goes_round_each_leg(around_legs, limbs, extent.bottom_y);
  return extent;
}

GarmentExtent up_to_the_waist(GarmentExtent bottom, const GarmentExtent& top, const BodyLimbs& limbs) {
  constexpr double kTouching_m = 0.05;
  const bool hidden = top.bottom_y < bottom.top_y + kTouching_m && top.top_y > limbs.waist_y;
  if (hidden) bottom.top_y = std::max(bottom.top_y, limbs.waist_y);
  return bottom;
}

CoveredBody::CoveredBody(const MeshQuery& naked, const BodyLimbs& limbs, const std::string& garment,
                         const GarmentExtent& extent, double margin_m)
    : naked_(naked),
      limbs_(limbs),
      extent_(extent),
      margin_m_(margin_m),
      kept_(kept_triangles(naked, limbs, garment, extent, margin_m + kBeyond_m)),
      covered_(only(naked.mesh(), kept_)),
      tube_(!extent.forked && extent.bottom_y < limbs.crotch_y + 0.06
                ? leg_tube(naked.mesh(), limbs, extent.bottom_y - margin_m - kBeyond_m)
                : Mesh{}) {
  const auto part_is = [&](auto&& wanted) {
    std::vector<bool> part(kept_.size());
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = kept_[i] && wanted(limbs.triangle_parts[i]);
    return MeshQuery(only(naked.mesh(), part));
  };
  for (int side = 0; side < 2 && garment == "top"; ++side) {
    if (!extent.has_arm[side]) continue;
    const BodyPart arm = side == 0 ? BodyPart::left_arm : BodyPart::right_arm;
    const Limb& limb = *limbs.arm(side);
    forks_.push_back({part_is([arm](BodyPart part) { return part == arm; }),
                      part_is([arm](BodyPart part) { return part != arm; }),
                      limb.root + limb.direction * extent.arm_free_along[side], limb.direction});
  }
  if (extent.forked)
    forks_.push_back({part_is([](BodyPart part) { return part == BodyPart::left_leg; }),
                      part_is([](BodyPart part) { return part == BodyPart::right_leg; }),
                      Vector3d(0, limbs.crotch_y - kForkSeam_m, 0), -Vector3d::UnitY()});
  bool first = true;
  for (const Mesh* mesh : {&covered_.mesh(), &tube_.mesh()})
    for (const Vector3d& v : mesh->vertices) {
      low_ = first ? v : Vector3d(low_.cwiseMin(v));
      high_ = first ? v : Vector3d(high_.cwiseMax(v));
      first = false;
    }
  const double bottom = extent.forked ? std::min(extent.leg_bottom_y[0], extent.leg_bottom_y[1]) : extent.bottom_y;
  double lowest = std::min(bottom, extent.bottom_y) - margin_m;
  for (int side = 0; side < 2; ++side)  // long sleeves reach below the hem
    if (extent.has_arm[side])
      lowest = std::min(lowest, lowest_of_arm(*limbs.arm(side), extent.arm_along[side] + margin_m) - margin_m);
  low_.y() = std::max(low_.y(), lowest);
  high_.y() = std::min(high_.y(), extent.top_y + margin_m);
}

double CoveredBody::signed_distance(const Vector3d& point, double bound_m) const {
  const auto closest = covered_.closest(point, bound_m);
  double distance = closest.distance;
  if (closest.triangle >= 0 && covered_.signed_distance(point, closest) < 0) {
    // Inside, unless it lies in a limb that was taken away.
    const auto nearest = naked_.closest(point, distance + 1e-6);
    if (nearest.triangle < 0 || kept_[nearest.triangle]) distance = -distance;
  }
  const auto tube = tube_.closest(point, std::min(bound_m, std::abs(distance)));
  return tube.triangle < 0 ? distance : std::min(distance, tube_.signed_distance(point, tube));
}

double CoveredBody::from_crevice(const Vector3d& point, double bound_m) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Fork& fork : forks_) {
    if ((point - fork.from).dot(fork.direction) < 0) continue;
    const double limb = fork.limb.closest(point).distance;
    if (!std::isfinite(limb)) continue;
    const double other = fork.other.closest(point, limb + 2 * bound_m).distance;
    if (std::isfinite(other)) nearest = std::min(nearest, std::abs(limb - other) / 2);
  }
  return nearest;
}

double CoveredBody::beyond_ends(const Vector3d& point) const {
  double bottom = extent_.bottom_y;
  if (extent_.forked && point.y() < limbs_.crotch_y) {
    const Vector3d left = limbs_.left_leg->root, right = limbs_.right_leg->root;
    bottom = extent_.leg_bottom_y[(point - (left + right) / 2).dot(limbs_.left) > 0 ? 0 : 1];
  }
  const double beyond = std::max(point.y() - extent_.top_y, bottom - point.y());
  for (int side = 0; side < 2; ++side) {
    if (!extent_.has_arm[side]) continue;
    const double past = limbs_.arm(side)->along(point) - extent_.arm_along[side];
    if (past < -margin_m_ - kBeyond_m && point.y() > bottom) continue;
    // A sleeve ends at its cuff, also where that is lower than the hem.
    const int triangle = naked_.closest(point).triangle;
    const BodyPart arm = side == 0 ? BodyPart::left_arm : BodyPart::right_arm;
    if (triangle >= 0 && limbs_.triangle_parts[triangle] == arm) return past - margin_m_;
  }
  return beyond - margin_m_;
}

}  // namespace dressform
