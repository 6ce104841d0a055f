#include "synthetic/garments/underarm.h"

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

constexpr double kLayer = 0.0065;     // each side's cloth stays this far off the body, m
constexpr double kHalfGap = 0.008;    // between the two layers where there is room, m
constexpr double kLeastRoom = 0.026;  // between arm and trunk for both layers and a gap, m
constexpr double kLeastSide = 0.02;   // the shortest inner side of a sleeve, m
constexpr double kSlope = 0.5;        // at which the gap opens downwards
constexpr double kStep = 0.004;       // along the arm, m
constexpr double kJump = 0.006;       // more than that from one step to the next, and the arm becomes part of the trunk
constexpr double kBelowJump = 0.010;  // the gap starts that much further down, m

// Whether the arm's outline is about the same a step further up.
bool goes_on(const Tube& arm, double s) {
  for (double angle = 0.5 * M_PI; angle < 1.5 * M_PI; angle += 0.1)
    if (std::abs(arm.radius(s, angle) - arm.radius(s - kStep, angle)) > kJump) return false;
  return true;
}

// Positive inside what is cut away from one side's layer: off its own body, and nearer to the other's.
double beyond_own_side(double to_own, double to_other) {
  return std::min(to_own - kLayer, kHalfGap + (to_own - to_other) / 2);
}

}  // namespace

Underarm::Underarm(const Tube& trunk, const Tube& arm, double side, double cuff_s)
    : trunk_(trunk), arm_(arm), side_(side) {
  const auto inner = [&](double s) { return arm_.point(s, M_PI, arm_.radius(s, M_PI)); };
  double s = cuff_s;
  while (s > 0 && trunk_.field(inner(s)) >= kLeastRoom && goes_on(arm_, s)) s -= kStep;
  // What is part of both would leave ragged shreds in the gap.
  if (s > 0 && !(goes_on(arm_, s + kStep) && goes_on(arm_, s) && goes_on(arm_, s - kStep))) s += kBelowJump;
  if (inner(s).y() - inner(cuff_s).y() >= kLeastSide) start_y_ = inner(s).y();
}

template <class Gap>
Field Underarm::cut(const Field& layer, const Gap& gap) const {
  if (!start_y_) return layer;
  return [layer, gap, trunk = trunk_, arm = arm_, side = side_, start_y = *start_y_](const Vector3d& p) {
    const double whole = layer(p);
    if (p.x() * side < 0 || whole > 0.02) return whole;
    return smooth_intersection(whole, std::min(gap(trunk.field(p), arm.field(p)), kSlope * (start_y - p.y())), 0.004);
  };
}

Field Underarm::parted(const Field& field) const {
  return cut(field, [](double to_trunk, double to_arm) {
    return std::min(std::min(to_trunk, to_arm) - kLayer, kHalfGap - std::abs(to_trunk - to_arm) / 2);
  });
}

Field Underarm::trunk_side(const Field& trunk_cloth) const { return cut(trunk_cloth, beyond_own_side); }
Field Underarm::arm_side(const Field& sleeve) const {
  return cut(sleeve, [](double to_trunk, double to_arm) { return beyond_own_side(to_arm, to_trunk); });
}

}  // namespace dressform
