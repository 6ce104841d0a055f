#include "pipeline/garment/garment_ends.h"

#include <algorithm>
#include <cmath>

#include "pipeline/geometry/submesh.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double kEndPart = 0.0005;        // of the points (and four at least) may lie beyond an end as strays
constexpr std::size_t kFewestOfLimb = 20;  // points about a limb: fewer are strays
constexpr double kPastCuff_m = 0.025;      // an arm comes off the trunk this far past the cuff at the latest ...
constexpr double kArmSeam_m = 0.02;        // ... and this far below the armpit at the earliest

// The least value when a few strays are left out.
double lower_end(std::vector<double> values) {
  const std::size_t strays = std::max<std::size_t>(4, static_cast<std::size_t>(kEndPart * values.size()));
  if (values.empty()) return 0;
  const std::size_t last = values.size() - 1;
  return nth_value(std::move(values), std::min(last, strays));
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
  return sleeve.size() < kFewestOfLimb ? 0 : upper_end(std::move(sleeve));
}

// How far down the arm points bridge it with the trunk, as cloth round the armhole does: Limb::along of the last such
// place. Below it, sleeve and trunk are two layers.
double bridged_along(const std::vector<Vector3d>& points, const MeshQuery& naked, const Landmarks& landmarks, int side,
                     double cuff_along) {
  constexpr double kBin_m = 0.01, kMiddle_m = 0.006, kReach_m = 0.08;
  constexpr std::size_t kFewest = 3;
  const BodyPart part = arm_part(side);
  std::vector<char> of_arm(landmarks.triangle_parts.size()), of_rest = of_arm;
  for (std::size_t i = 0; i < of_arm.size(); ++i) of_rest[i] = !(of_arm[i] = landmarks.triangle_parts[i] == part);
  const MeshQuery arm(submesh(naked.mesh(), of_arm)), rest(submesh(naked.mesh(), of_rest));
  std::vector<std::size_t> between(std::max(1, static_cast<int>(cuff_along / kBin_m) + 1), 0);
  for (const Vector3d& p : points) {
    const double along = landmarks.arm(side)->along(p);
    if (along < 0 || along >= cuff_along) continue;
    const double to_arm = arm.closest(p, kReach_m).distance, to_rest = rest.closest(p, kReach_m).distance;
    if (std::isfinite(to_arm) && std::isfinite(to_rest) && std::abs(to_arm - to_rest) < 2 * kMiddle_m)
      ++between[static_cast<std::size_t>(along / kBin_m)];
  }
  std::size_t last = 0;
  while (last < between.size() && between[last] >= kFewest) ++last;
  return kBin_m * static_cast<double>(last);
}

// Points of a garment by what they are about.
struct PointsByLimb {
  std::vector<double> heights;              // on trunk and legs
  std::array<std::vector<double>, 2> arms;  // Limb::along
  std::array<std::vector<double>, 2> legs;  // heights, below the crotch
};

// The leg on whose outer side of its root the point lies further out.
int leg_near(const Vector3d& p, const Landmarks& landmarks) {
  const double left = (p - (landmarks.left_leg ? landmarks.left_leg->root : Vector3d::Zero())).dot(landmarks.left);
  const double right = landmarks.right_leg ? (landmarks.right_leg->root - p).dot(landmarks.left) : 0;
  return left > right ? 0 : 1;
}

PointsByLimb by_limb(const std::vector<Vector3d>& points, bool upper, const MeshQuery& naked,
                     const Landmarks& landmarks) {
  PointsByLimb result;
  for (const Vector3d& p : points) {
    const BodyPart part = landmarks.part_of(naked.closest(p).triangle);
    if (is_arm(part) && upper) {
      result.arms[side_of(part)].push_back(landmarks.arm(side_of(part))->along(p));
      continue;
    }
    result.heights.push_back(p.y());
    if (p.y() <= landmarks.crotch_y) result.legs[leg_near(p, landmarks)].push_back(p.y());
  }
  return result;
}

}  // namespace

GarmentLayout with_ends(GarmentLayout layout, const std::vector<Vector3d>& points, const MeshQuery& naked,
                        const Landmarks& landmarks) {
  const PointsByLimb found = by_limb(points, layout.upper(), naked, landmarks);
  layout.top_y = upper_end(found.heights);
  layout.bottom_y = lower_end(found.heights);
  for (int side = 0; side < 2; ++side) {
    LimbCover &arm = layout.arms[side], &leg = layout.legs[side];
    arm.covered = landmarks.arm(side) && layout.upper();
    arm.end_m = sleeve_end(found.arms[side]);
    arm.free_m = arm.end_m + kPastCuff_m;
    if (arm.covered)
      arm.free_m = std::min(arm.free_m, kArmSeam_m + bridged_along(points, naked, landmarks, side, arm.end_m));
    leg.covered = landmarks.leg(side) && layout.forked();
    leg.end_y = found.legs[side].size() < kFewestOfLimb ? layout.bottom_y : lower_end(found.legs[side]);
    const Limb* axis = landmarks.leg(side);
    leg.end_m = axis && axis->direction.y() < 0 ? (leg.end_y - axis->root.y()) / axis->direction.y() : 0;
  }
  return layout;
}

GarmentLayout up_to_the_waist(GarmentLayout bottom, const GarmentLayout& top, const Landmarks& landmarks) {
  constexpr double kTouching_m = 0.05;
  const bool hidden = top.bottom_y < bottom.top_y + kTouching_m && top.top_y > landmarks.waist_y;
  if (hidden) bottom.top_y = std::max(bottom.top_y, landmarks.waist_y);
  return bottom;
}

}  // namespace dressform
