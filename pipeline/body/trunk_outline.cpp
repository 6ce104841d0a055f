#include "pipeline/body/trunk_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace dressform {
namespace {

constexpr double kStep_m = 0.003;        // across the body
constexpr double kInnermostArm = 0.055;  // of the stature: nearer to the middle no arm begins
constexpr double kRise_m = 0.015;        // by which a section thickens again where an arm follows
constexpr double kJoint = 0.6;           // of the trunk's thickness: what is thicker is shoulder

// Front-to-back thickness of the loop along the line at `aside` to the left of the middle.
double thickness_at(const SectionLoop& loop, const Vector3d& middle, const Vector3d& left, double aside) {
  const Vector3d front = left.cross(Vector3d::UnitY());
  std::vector<double> crossings;
  for (std::size_t i = 0, j = loop.points.size() - 1; i < loop.points.size(); j = i++) {
    const double a = left.dot(loop.points[j] - middle) - aside, b = left.dot(loop.points[i] - middle) - aside;
    if ((a < 0) != (b < 0))
      crossings.push_back(front.dot(loop.points[j] + a / (a - b) * (loop.points[i] - loop.points[j])));
  }
  std::sort(crossings.begin(), crossings.end());
  double thickness = 0;
  for (std::size_t i = 1; i < crossings.size(); i += 2) thickness += crossings[i] - crossings[i - 1];
  return thickness;
}

struct ArmCut {
  double aside = 0, joint = 0;
};
std::optional<ArmCut> arm_cut(const SectionLoop& loop, const Vector3d& middle, const Vector3d& outwards,
                              double stature) {
  double thickest = 0, thinnest = std::numeric_limits<double>::infinity(), at = 0;
  for (double aside = 0; aside < 0.4 * stature; aside += kStep_m) {
    const double thickness = thickness_at(loop, middle, outwards, aside);
    thickest = std::max(thickest, thickness);
    if (aside < kInnermostArm * stature) continue;
    if (thickness <= 0) return {};
    if (thickness < thinnest - 0.002) thinnest = thickness, at = aside;  // the inner end of a level web
    if (thickness > thinnest + kRise_m && thinnest < kJoint * thickest) return ArmCut{at, thinnest / thickest};
  }
  return {};
}

// The part of a polygon where normal.p <= offset (Sutherland and Hodgman, CACM 1974).
std::vector<Vector3d> clipped(const std::vector<Vector3d>& polygon, const Vector3d& normal, double offset) {
  std::vector<Vector3d> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double a = normal.dot(from) - offset, b = normal.dot(to) - offset;
    if (a <= 0) result.push_back(from);
    if ((a <= 0) != (b <= 0)) result.push_back(from + a / (a - b) * (to - from));
  }
  return result;
}

}  // namespace

TrunkOutline trunk_outline(const std::vector<SectionLoop>& loops, const Vector3d& middle, const Vector3d& left,
                           double stature) {
  TrunkOutline result;
  if (loops.empty()) return result;
  result.trunk = loops[0];
  for (std::size_t i = 1; i < loops.size(); ++i) result.limbs.push_back(loops[i].points);
  for (const double sign : {1.0, -1.0}) {
    const Vector3d outwards = sign * left;
    const auto cut = arm_cut(loops[0], middle, outwards, stature);
    if (!cut) continue;
    const double offset = outwards.dot(middle) + cut->aside;
    result.limbs.push_back(clipped(loops[0].points, -outwards, -offset));
    result.trunk.points = clipped(result.trunk.points, outwards, offset);
    result.joint = std::max(result.joint, cut->joint);
  }
  return result;
}

double horizontal_distance(const Vector3d& point, const std::vector<Vector3d>& line) {
  double best = std::numeric_limits<double>::infinity();
  const Vector3d flat(1, 0, 1);
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vector3d side = (line[(i + 1) % line.size()] - line[i]).cwiseProduct(flat);
    const Vector3d off = (point - line[i]).cwiseProduct(flat);
    const double length = side.squaredNorm();
    const double along = length > 0 ? std::clamp(off.dot(side) / length, 0.0, 1.0) : 0;
    best = std::min(best, (off - along * side).squaredNorm());
  }
  return std::sqrt(best);
}

}  // namespace dressform
