#include "pipeline/body/body_limbs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipeline/body/section_tracks.h"
#include "scenes/error.h"

namespace dressform {
namespace {

constexpr double kLeastFoot_m = 0.01;  // feet that reach less far beyond the ankles say nothing
constexpr double kFoot_m = 0.04;       // height of the foot over the floor, and of the ankle: above it
constexpr double kAnkle_m[2] = {0.09, 0.14};
constexpr double kUsualArmpit = 0.74;    // of the stature, where the sections show no arm
constexpr std::size_t kFewestLoops = 8;  // of an arm: shorter runs are crumbs beside the trunk

Vector3d horizontal(Vector3d v) {
  v.y() = 0;
  return v.norm() > 1e-9 ? Vector3d(v.normalized()) : Vector3d::Zero();
}

// How far the feet reach beyond the ankles, horizontally, the mean of both.
Vector3d foot_direction(const Sections& sections, const LegTracks& legs) {
  Vector3d sum = Vector3d::Zero();
  for (const SectionTrack& leg : legs.tracks) {
    Vector3d foot = Vector3d::Zero(), ankle = Vector3d::Zero();
    int feet = 0, ankles = 0;
    for (const auto& [level, loop] : leg.loops) {
      const double height = level * sections.step;
      const Vector3d& centre = sections.levels[level][loop].centroid;
      if (height < kFoot_m) foot += centre, ++feet;
      if (height > kAnkle_m[0] && height < kAnkle_m[1]) ankle += centre, ++ankles;
    }
    if (feet && ankles) sum += foot / feet - ankle / ankles;
  }
  sum.y() = 0;
  return sum / 2;
}

// Across the body, from one leg to the other; zero without legs, or where one stands right before the other.
Vector3d across(const Sections& sections, const LegTracks& legs) {
  if (!legs.found) return Vector3d::Zero();
  const auto& a = legs.tracks[0].loops.back();
  const auto& b = legs.tracks[1].loops.back();
  return horizontal(sections.levels[b.first][b.second].centroid - sections.levels[a.first][a.second].centroid);
}

// Legs tell the sideways direction, and feet or the hint which of the two ways is forward.
void find_front(const Sections& sections, const LegTracks& legs, const std::optional<Vector3d>& hint,
                BodyLimbs& limbs) {
  const Vector3d feet = legs.found ? foot_direction(sections, legs) : Vector3d::Zero();
  const Vector3d sideways = across(sections, legs);
  const Vector3d forward = hint ? horizontal(*hint) : feet;
  if (sideways.norm() > 0.5) {
    limbs.front = sideways.cross(Vector3d::UnitY()).normalized();
    const bool told = hint ? forward.norm() > 0 : forward.norm() > kLeastFoot_m;
    if (told && forward.dot(limbs.front) < 0) limbs.front = -limbs.front;
    if (told) limbs.front_from = hint ? FrontFrom::rig : FrontFrom::feet;
  } else if (forward.norm() > 1e-6) {
    limbs.front = horizontal(forward);
    limbs.front_from = hint ? FrontFrom::rig : FrontFrom::feet;
  }
  limbs.left = Vector3d::UnitY().cross(limbs.front);
  limbs.feet_forward_m = feet.dot(limbs.front);
}

Limb straight_limb(const Sections& sections, const std::vector<LoopIndex>& upwards) {
  Limb limb;
  for (auto at = upwards.rbegin(); at != upwards.rend(); ++at)
    limb.centres.push_back(sections.levels[at->first][at->second].centroid);
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& centre : limb.centres) mean += centre / limb.centres.size();
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  double spread = 0;
  for (const Vector3d& centre : limb.centres) {
    const Vector3d d = centre - mean;
    slope += d.y() * Eigen::Vector2d(d.x(), d.z());
    spread += d.y() * d.y();
  }
  if (spread > 0) slope /= spread;
  limb.direction = -Vector3d(slope.x(), 1, slope.y()).normalized();
  limb.fork_y = sections.y(upwards.back().first);
  limb.root = mean + limb.direction * ((limb.fork_y - mean.y()) / limb.direction.y());
  limb.length = limb.along(limb.centres.back());
  return limb;
}

// Loops that are neither leg nor torso, at one side of the torso: the longest run of them is the arm, from the highest
// level downwards.
std::vector<LoopIndex> arm_loops(const Sections& sections, const SectionTags& tags, const SectionTrack& torso,
                                 const BodyLimbs& limbs, int side) {
  const int count = static_cast<int>(sections.levels.size());
  std::vector<LoopIndex> downwards, longest;
  Vector3d axis = Vector3d::Zero();
  for (const auto& [level, loop] : torso.loops) axis += sections.levels[level][loop].centroid / torso.loops.size();
  for (int level = count * 92 / 100; level > count * 3 / 10; --level) {
    if (!downwards.empty() && downwards.back().first - level > 4) downwards.clear();
    for (std::size_t i = 0; i < sections.levels[level].size(); ++i) {
      if (tags.part[level][i] >= 0) continue;
      const double sideways = (sections.levels[level][i].centroid - axis).dot(limbs.left);
      if ((side == 0) != (sideways > 0)) continue;
      if (!downwards.empty() &&
          !overlap(sections.levels[level][i], sections.levels[downwards.back().first][downwards.back().second]))
        continue;
      downwards.push_back({level, static_cast<int>(i)});
      if (downwards.size() > longest.size()) longest = downwards;
      break;
    }
  }
  return longest;
}

void tag(SectionTags& tags, const std::vector<LoopIndex>& loops, BodyPart part) {
  for (const auto& [level, loop] : loops) tags.part[level][loop] = static_cast<int>(part);
}

void add_legs(const Sections& sections, const LegTracks& legs, BodyLimbs& limbs, SectionTags& tags) {
  limbs.crotch_y = sections.y(legs.crotch_level);
  const auto& [level, loop] = legs.tracks[0].loops.back();
  const auto& [other_level, other] = legs.tracks[1].loops.back();
  const Vector3d apart = sections.levels[level][loop].centroid - sections.levels[other_level][other].centroid;
  const int left = apart.dot(limbs.left) > 0 ? 0 : 1;
  limbs.left_leg = straight_limb(sections, legs.tracks[left].loops);
  limbs.right_leg = straight_limb(sections, legs.tracks[1 - left].loops);
  tag(tags, legs.tracks[left].loops, BodyPart::left_leg);
  tag(tags, legs.tracks[1 - left].loops, BodyPart::right_leg);
}

void add_arms(const Sections& sections, const SectionTrack& torso, BodyLimbs& limbs, SectionTags& tags) {
  for (int side = 0; side < 2; ++side) {
    auto loops = arm_loops(sections, tags, torso, limbs, side);
    if (loops.size() < kFewestLoops) continue;
    std::reverse(loops.begin(), loops.end());
    (side == 0 ? limbs.left_arm : limbs.right_arm) = straight_limb(sections, loops);
    tag(tags, loops, arm_part(side));
  }
  if (limbs.left_arm) limbs.armpit_y = limbs.left_arm->fork_y;
  if (limbs.right_arm) limbs.armpit_y = std::max(limbs.left_arm ? limbs.armpit_y : 0, limbs.right_arm->fork_y);
}

}  // namespace

const Limb* BodyLimbs::arm(int side) const {
  const auto& limb = side == 0 ? left_arm : right_arm;
  return limb ? &*limb : nullptr;
}

const Limb* BodyLimbs::leg(int side) const {
  const auto& limb = side == 0 ? left_leg : right_leg;
  return limb ? &*limb : nullptr;
}

BodyLimbs find_limbs(const Mesh& body, const std::optional<Vector3d>& front_hint) {
  return find_limbs(body, horizontal_sections(body), front_hint);
}

BodyLimbs find_limbs(const Mesh& body, const Sections& sections, const std::optional<Vector3d>& front_hint) {
  return tagged_limbs(body, sections, front_hint).limbs;
}

TaggedLimbs tagged_limbs(const Mesh& body, const Sections& sections, const std::optional<Vector3d>& front_hint) {
  if (body.triangles.empty()) throw InputError("naked body", "the mesh has no triangle; expected a closed body");
  BodyLimbs limbs;
  limbs.floor_y = sections.first_y;
  limbs.top_y = sections.y(static_cast<int>(sections.levels.size()) - 1);
  limbs.crotch_y = limbs.floor_y;
  limbs.armpit_y = limbs.floor_y + kUsualArmpit * (limbs.top_y - limbs.floor_y);
  const LegTracks legs = find_legs(sections);
  const SectionTrack torso = find_torso(sections, legs);
  find_front(sections, legs, front_hint, limbs);
  SectionTags tags(sections);
  tag(tags, torso.loops, BodyPart::torso);
  if (legs.found) add_legs(sections, legs, limbs, tags);
  add_arms(sections, torso, limbs, tags);
  return {std::move(limbs), std::move(tags), torso};
}

}  // namespace dressform
