#include "pipeline/body/body_limbs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/error.h"

namespace dressform {
namespace {

using LoopIndex = std::pair<int, int>;  // level, loop

constexpr double kFootLength_m = 0.02;  // feet that point less than this far forward say nothing

// The parts of every loop, kept beside the sections; -1 = none of the known.
struct Tags {
  std::vector<std::vector<int>> part;

  explicit Tags(const Sections& sections) {
    for (const auto& level : sections.levels) part.emplace_back(level.size(), -1);
  }
};

bool overlap(const SectionLoop& a, const SectionLoop& b) {
  if (contains(a, b.centroid) || contains(b, a.centroid)) return true;
  for (std::size_t i = 0; i < a.points.size(); i += 4)
    if (contains(b, a.points[i])) return true;
  return false;
}

// The largest loop of `level` that overlaps `loop`, or -1.
int follow(const Sections& sections, const SectionLoop& loop, int level) {
  if (level < 0 || level >= static_cast<int>(sections.levels.size())) return -1;
  for (std::size_t i = 0; i < sections.levels[level].size(); ++i)
    if (overlap(sections.levels[level][i], loop)) return static_cast<int>(i);
  return -1;
}

struct Track {
  std::vector<LoopIndex> loops;  // upwards
};

Track track_down(const Sections& sections, LoopIndex at) {
  Track track{{at}};
  while (true) {
    const int next = follow(sections, sections.levels[at.first][at.second], at.first - 1);
    if (next < 0) break;
    at = {at.first - 1, next};
    track.loops.push_back(at);
  }
  std::reverse(track.loops.begin(), track.loops.end());
  return track;
}

struct Legs {
  bool found = false;
  int crotch_level = 0;  // the first level where they are one
  int crotch_loop = 0;
  Track tracks[2];
};

// Two loops a little above the ankles, followed upwards until they are one.
Legs find_legs(const Sections& sections) {
  Legs legs;
  const int count = static_cast<int>(sections.levels.size());
  for (const double part : {0.14, 0.20, 0.26, 0.10}) {
    const int start = static_cast<int>(part * count);
    if (start >= count || sections.levels[start].size() < 2) continue;
    LoopIndex at[2] = {{start, 0}, {start, 1}};
    for (int k = 0; k < 2; ++k) legs.tracks[k] = track_down(sections, at[k]);
    for (int level = start + 1; level < count * 7 / 10; ++level) {
      int next[2];
      for (int k = 0; k < 2; ++k) next[k] = follow(sections, sections.levels[at[k].first][at[k].second], level);
      if (next[0] < 0 || next[1] < 0) break;
      if (next[0] == next[1]) {
        legs.found = true;
        legs.crotch_level = level;
        legs.crotch_loop = next[0];
        return legs;
      }
      for (int k = 0; k < 2; ++k) {
        at[k] = {level, next[k]};
        legs.tracks[k].loops.push_back(at[k]);
      }
    }
  }
  return legs;
}

// The torso from the crotch to the top of the head; without legs from the floor.
Track find_torso(const Sections& sections, const Legs& legs) {
  Track track;
  const int count = static_cast<int>(sections.levels.size());
  LoopIndex at = legs.found ? LoopIndex{legs.crotch_level, legs.crotch_loop} : LoopIndex{count / 2, 0};
  while (at.first < count && sections.levels[at.first].empty()) ++at.first;
  if (at.first >= count) return track;
  track = legs.found ? Track{{at}} : track_down(sections, at);
  while (true) {
    const int next = follow(sections, sections.levels[at.first][at.second], at.first + 1);
    if (next < 0) break;
    at = {at.first + 1, next};
    track.loops.push_back(at);
  }
  return track;
}

double girth(const SectionLoop& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.points.size(); ++i)
    sum += (loop.points[(i + 1) % loop.points.size()] - loop.points[i]).norm();
  return sum;
}

Vector3d horizontal(Vector3d v) {
  v.y() = 0;
  return v.norm() > 1e-9 ? Vector3d(v.normalized()) : Vector3d::Zero();
}

Vector3d foot_direction(const Sections& sections, const Legs& legs) {
  Vector3d sum = Vector3d::Zero();
  for (const Track& leg : legs.tracks) {
    Vector3d foot = Vector3d::Zero(), ankle = Vector3d::Zero();
    int feet = 0, ankles = 0;
    for (const auto& [level, loop] : leg.loops) {
      const double height = level * sections.step;
      const Vector3d& centre = sections.levels[level][loop].centroid;
      if (height < 0.04) foot += centre, ++feet;
      if (height > 0.09 && height < 0.14) ankle += centre, ++ankles;
    }
    if (feet && ankles) sum += foot / feet - ankle / ankles;
  }
  sum.y() = 0;
  return sum;
}

void find_front(const Sections& sections, const Legs& legs, const std::optional<Vector3d>& hint, BodyLimbs& limbs) {
  Vector3d toes = hint ? horizontal(*hint) : Vector3d::Zero();
  if (legs.found) {
    if (!hint) toes = foot_direction(sections, legs);
    const auto& a = legs.tracks[0].loops.back();
    const auto& b = legs.tracks[1].loops.back();
    const Vector3d sideways =
        horizontal(sections.levels[b.first][b.second].centroid - sections.levels[a.first][a.second].centroid);
    Vector3d front = sideways.cross(Vector3d::UnitY());
    if (front.norm() > 0.5) {
      if (toes.norm() > (hint ? 0 : kFootLength_m) && toes.dot(front) < 0) front = -front;
      limbs.front = front.normalized();
      limbs.left = Vector3d::UnitY().cross(limbs.front);
      return;
    }
  }
  if (toes.norm() > 1e-6) limbs.front = horizontal(toes);
  limbs.left = Vector3d::UnitY().cross(limbs.front);
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
std::vector<LoopIndex> arm_loops(const Sections& sections, const Tags& tags, const Track& torso, const BodyLimbs& limbs,
                                 int side) {
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

void tag(Tags& tags, const std::vector<LoopIndex>& loops, BodyPart part) {
  for (const auto& [level, loop] : loops) tags.part[level][loop] = static_cast<int>(part);
}

void find_heights(const Sections& sections, const Track& torso, BodyLimbs& limbs) {
  const double height = limbs.top_y - limbs.floor_y;
  const double neck_from = std::max(limbs.armpit_y + 0.03 * height, limbs.floor_y + 0.78 * height);
  double narrowest_neck = std::numeric_limits<double>::infinity(), narrowest_waist = narrowest_neck;
  limbs.neck_y = limbs.top_y;
  limbs.waist_y = limbs.floor_y + 0.6 * height;
  for (const auto& [level, loop] : torso.loops) {
    const double y = sections.y(level), around = girth(sections.levels[level][loop]);
    if (y > neck_from && y < limbs.floor_y + 0.94 * height && around < narrowest_neck) {
      narrowest_neck = around;
      limbs.neck_y = y;
      limbs.neck = sections.levels[level][loop].centroid;
    }
    if (y > limbs.crotch_y + 0.06 * height && y < limbs.armpit_y - 0.03 * height && around < narrowest_waist) {
      narrowest_waist = around;
      limbs.waist_y = y;
    }
  }
}

double distance_to(const SectionLoop& loop, const Vector3d& point) {
  double best = std::numeric_limits<double>::infinity();
  for (const Vector3d& p : loop.points)
    best = std::min(best, (p.x() - point.x()) * (p.x() - point.x()) + (p.z() - point.z()) * (p.z() - point.z()));
  return best;
}

BodyPart part_of(const Vector3d& point, const Sections& sections, const Tags& tags, const BodyLimbs& limbs) {
  for (int side = 0; side < 2; ++side) {  // the shoulder's lower end, above the armpit
    const Limb* arm = limbs.arm(side);
    if (!arm || point.y() < arm->fork_y || arm->along(point) < 0) continue;
    if ((point - arm->root - arm->along(point) * arm->direction).norm() < 0.12)
      return side == 0 ? BodyPart::left_arm : BodyPart::right_arm;
  }
  if (point.y() > limbs.neck_y) return BodyPart::head;
  const int level = sections.level(point.y());
  double nearest = std::numeric_limits<double>::infinity();
  int part = static_cast<int>(BodyPart::torso);
  for (std::size_t i = 0; level >= 0 && i < sections.levels[level].size(); ++i) {
    const double distance = distance_to(sections.levels[level][i], point);
    if (tags.part[level][i] < 0 || distance >= nearest) continue;
    nearest = distance;
    part = tags.part[level][i];
  }
  // Fingers have loops too small to count: they belong to the arm whose end is close.
  for (int side = 0; side < 2; ++side) {
    const Limb* arm = limbs.arm(side);
    if (arm && (point - arm->centres.back()).squaredNorm() < std::min(nearest, 0.0225) &&
        arm->along(point) > arm->length - 0.03)
      part = static_cast<int>(side == 0 ? BodyPart::left_arm : BodyPart::right_arm);
  }
  return static_cast<BodyPart>(part);
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
  if (body.triangles.empty()) throw InputError("naked body", "the mesh has no triangle; expected a closed body");
  BodyLimbs limbs;
  limbs.floor_y = sections.first_y;
  limbs.top_y = sections.y(static_cast<int>(sections.levels.size()) - 1);
  limbs.crotch_y = limbs.floor_y;
  limbs.armpit_y = limbs.floor_y + 0.74 * (limbs.top_y - limbs.floor_y);

  const Legs legs = find_legs(sections);
  const Track torso = find_torso(sections, legs);
  find_front(sections, legs, front_hint, limbs);
  Tags tags(sections);
  tag(tags, torso.loops, BodyPart::torso);
  if (legs.found) {
    limbs.crotch_y = sections.y(legs.crotch_level);
    const auto& [level, loop] = legs.tracks[0].loops.back();
    const auto& [other_level, other] = legs.tracks[1].loops.back();
    const int left =
        (sections.levels[level][loop].centroid - sections.levels[other_level][other].centroid).dot(limbs.left) > 0 ? 0
                                                                                                                   : 1;
    limbs.left_leg = straight_limb(sections, legs.tracks[left].loops);
    limbs.right_leg = straight_limb(sections, legs.tracks[1 - left].loops);
    tag(tags, legs.tracks[left].loops, BodyPart::left_leg);
    tag(tags, legs.tracks[1 - left].loops, BodyPart::right_leg);
  }
  for (int side = 0; side < 2; ++side) {
    auto loops = arm_loops(sections, tags, torso, limbs, side);
    if (loops.size() < 8) continue;
    std::reverse(loops.begin(), loops.end());
    (side == 0 ? limbs.left_arm : limbs.right_arm) = straight_limb(sections, loops);
    tag(tags, loops, side == 0 ? BodyPart::left_arm : BodyPart::right_arm);
  }
  if (limbs.left_arm) limbs.armpit_y = limbs.left_arm->fork_y;
  if (limbs.right_arm) limbs.armpit_y = std::max(limbs.left_arm ? limbs.armpit_y : 0, limbs.right_arm->fork_y);
  find_heights(sections, torso, limbs);

  for (const Vector3i& t : body.triangles)
    limbs.triangle_parts.push_back(
        part_of((body.vertices[t[0]] + body.vertices[t[1]] + body.vertices[t[2]]) / 3, sections, tags, limbs));
  return limbs;
}

}  // namespace dressform
