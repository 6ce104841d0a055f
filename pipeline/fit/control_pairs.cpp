#include "pipeline/fit/control_pairs.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dressform {
namespace {

constexpr double kLegEnd = 0.06;                            // of the way from floor to crotch: feet turn as they like
constexpr double kTrunkReach_m = 0.4, kLegReach_m = 0.2;    // from the axis: beyond lies something else
constexpr double kTrunkParts[] = {0.08, 0.22, 0.42, 0.28};  // of its rings, crotch to neck: as long as the parts are
constexpr double kHeadLevels[] = {4.0, 4.25, 4.5, 4.75, 4.93};
constexpr double kLegTop = 0.97, kArmTop = 0.05, kArmSpan = 0.85;  // of the limbs: where rings lie
constexpr double kWholeArm = 0.88;  // of the other body's length over stature: a shorter arm has lost its hand
// An arm against the trunk: from here down, no longer than arms are, this far about its axis.
constexpr double kArmFrom_m = 0.08, kLongestArm = 0.45, kAgainstTrunk_m = 0.065;
constexpr double kArmRadius_m = 0.085;  // nothing further from an arm's axis belongs to it

struct Side {
  const StandingBody& body;
  const MeshQuery& surface;
};

using Ring = std::vector<std::optional<Vector3d>>;

// First hits of rays from `centre` in the plane of u and v.
Ring ring(const MeshQuery& surface, const Vector3d& centre, const Vector3d& u, const Vector3d& v, int angles,
          double farthest) {
  Ring result(angles);
  for (int i = 0; i < angles; ++i) {
    const double angle = 2 * M_PI * i / angles;
    const Vector3d direction = (std::cos(angle) * u + std::sin(angle) * v).normalized();
    const auto hit = surface.first_hit(centre, direction);
    if (hit && hit->distance < farthest && surface.normal(hit->triangle).dot(direction) > 0) result[i] = hit->point;
  }
  return result;
}

void add_pairs(const Ring& from, const Ring& to, BodyPart part, std::vector<ControlPair>& pairs) {
  for (std::size_t i = 0; i < from.size(); ++i)
    if (from[i] && to[i]) pairs.push_back({*from[i], *to[i], part});
}

// Whether the point is on an arm that lies against the trunk: near the arm's axis, drawn on past its last section.
bool on_arm(const StandingBody& body, const Vector3d& point) {
  for (int side = 0; side < 2; ++side) {
    const Limb* arm = body.landmarks.arm(side);
    if (!arm) continue;
    const double along = arm->along(point);
    if (along < kArmFrom_m || along > kLongestArm * body.landmarks.stature) continue;
    if ((point - arm->root - along * arm->direction).norm() < kAgainstTrunk_m) return true;
  }
  return false;
}

// A ring round the trunk at height y.
Ring trunk_ring(const Side& side, double y, int angles, bool below_armpit) {
  const SectionLoop* loop = side.body.trunk_loop(y);
  if (!loop) return Ring(angles);
  Vector3d centre = loop->centroid;
  centre.y() = y;
  const Vector3d &front = side.body.landmarks.front, &left = side.body.landmarks.left;
  const Ring cross = ring(side.surface, centre, front, left, 4, kTrunkReach_m);
  for (const auto& hit : cross)
    if (!hit) return Ring(angles);
  const double depth = (*cross[0] - *cross[2]).norm() / 2, breadth = (*cross[1] - *cross[3]).norm() / 2;
  Ring result = ring(side.surface, centre, depth * front, breadth * left, angles, kTrunkReach_m);
  if (below_armpit)
    for (auto& hit : result)
      if (hit && on_arm(side.body, *hit)) hit.reset();
  return result;
}

// Height on either body at part t of the trunk: 0 crotch, 1 hip, 2 waist, 3 armpit, 4 neck, 5 top of the head.
double trunk_height(const StandingBody& body, double t) {
  const Landmarks& marks = body.landmarks;
  return height_at({marks.crotch_y, marks.hip_y, marks.waist_y, marks.armpit_y, marks.neck_y,
                    body.landmarks.floor_y + body.landmarks.stature},
                   t);
}

void add_trunk(const Side& naked, const Side& user, const ControlPairParams& params, std::vector<ControlPair>& pairs) {
  // As many rings to each part of the trunk as it is long.
  for (int part = 0; part < 4; ++part) {
    const int levels = std::max(1, static_cast<int>(std::lround(kTrunkParts[part] * params.trunk_levels)));
    for (int level = 0; level < levels; ++level) {
      const double t = part + (level + 0.5) / levels;
      add_pairs(trunk_ring(naked, trunk_height(naked.body, t), params.trunk_angles, t < 3),
                trunk_ring(user, trunk_height(user.body, t), params.trunk_angles, t < 3), BodyPart::torso, pairs);
    }
  }
  for (const double t : kHeadLevels)
    add_pairs(trunk_ring(naked, trunk_height(naked.body, t), 8, false),
              trunk_ring(user, trunk_height(user.body, t), 8, false), BodyPart::head, pairs);
}

// The point of the limb's middle line at height y, between the section centroids; beyond them on the straight axis.
Vector3d middle_at(const Limb& limb, double y) {
  for (std::size_t i = 1; i < limb.centres.size(); ++i) {
    const Vector3d &above = limb.centres[i - 1], &below = limb.centres[i];
    if (y > above.y() || y < below.y() || above.y() <= below.y()) continue;
    return above + (above.y() - y) / (above.y() - below.y()) * (below - above);
  }
  return limb.root + (y - limb.root.y()) / limb.direction.y() * limb.direction;
}

void add_leg(const Side& naked, const Side& user, int side, const ControlPairParams& params,
             std::vector<ControlPair>& pairs) {
  const Limb *from = naked.body.landmarks.leg(side), *to = user.body.landmarks.leg(side);
  if (!from || !to) return;
  const auto leg_ring = [&](const Side& each, const Limb& limb, double t) {
    const Landmarks& marks = each.body.landmarks;
    const double y = marks.floor_y + t * (marks.crotch_y - marks.floor_y);
    if (y > limb.fork_y) return Ring(params.limb_angles);
    return ring(each.surface, middle_at(limb, y), marks.front, marks.left, params.limb_angles, kLegReach_m);
  };
  for (int level = 0; level < params.limb_levels; ++level) {
    const double t = kLegEnd + (kLegTop - kLegEnd) * level / (params.limb_levels - 1);
    add_pairs(leg_ring(naked, *from, t), leg_ring(user, *to, t), side == 0 ? BodyPart::left_leg : BodyPart::right_leg,
              pairs);
  }
}

// Armpit to finger tips. Where the hand is lost against the thigh, as long as the other body's for its stature.
double arm_length(const StandingBody& body, const Limb& arm, const StandingBody& other, const Limb& other_arm) {
  const double own = arm.length / body.landmarks.stature, others = other_arm.length / other.landmarks.stature;
  return own < kWholeArm * others ? others * body.landmarks.stature : arm.length;
}

void add_arm(const Side& naked, const Side& user, int side, const ControlPairParams& params,
             std::vector<ControlPair>& pairs) {
  const Limb *from = naked.body.landmarks.arm(side), *to = user.body.landmarks.arm(side);
  if (!from || !to) return;
  const double from_length = arm_length(naked.body, *from, user.body, *to);
  const double to_length = arm_length(user.body, *to, naked.body, *from);
  const auto arm_ring = [&](const Side& each, const Limb& limb, double along) {
    const Vector3d middle = middle_at(limb, limb.root.y() + along * limb.direction.y());
    const Vector3d u =
        (each.body.landmarks.front - each.body.landmarks.front.dot(limb.direction) * limb.direction).normalized();
    return ring(each.surface, middle, u, limb.direction.cross(u), params.limb_angles, kArmRadius_m);
  };
  for (int level = 0; level < params.limb_levels; ++level) {
    const double t = kArmTop + kArmSpan * level / (params.limb_levels - 1);
    add_pairs(arm_ring(naked, *from, t * from_length), arm_ring(user, *to, t * to_length),
              side == 0 ? BodyPart::left_arm : BodyPart::right_arm, pairs);
  }
}

}  // namespace

std::vector<ControlPair> landmark_pairs(const StandingBody& naked, const MeshQuery& naked_surface,
                                        const StandingBody& user, const MeshQuery& user_surface,
                                        const ControlPairParams& params) {
  const Side from{naked, naked_surface}, to{user, user_surface};
  std::vector<ControlPair> pairs;
  add_trunk(from, to, params, pairs);
  for (int side = 0; side < 2; ++side) {
    add_leg(from, to, side, params, pairs);
    add_arm(from, to, side, params, pairs);
  }
  return pairs;
}

}  // namespace dressform
