#include "pipeline/body/body_landmarks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "pipeline/body/section_tracks.h"
#include "pipeline/body/standing_body.h"
#include "pipeline/body/tape_heights.h"
#include "scenes/error.h"

namespace dressform {
namespace {

constexpr double kShoulder_m = 0.12;                  // from the arm's axis, above the armpit: still the arm
constexpr double kFingers_m = 0.15;                   // from the middle of the arm's last section
constexpr double kLastOfArm_m = 0.03;                 // before that, a point has sections of its own
constexpr double kTrunkFrom = 0.52, kTrunkTo = 0.64;  // of the stature: trunk on anyone

double distance_to(const SectionLoop& loop, const Vector3d& point) {
  double best = std::numeric_limits<double>::infinity();
  for (const Vector3d& p : loop.points)
    best = std::min(best, (p.x() - point.x()) * (p.x() - point.x()) + (p.z() - point.z()) * (p.z() - point.z()));
  return best;
}

BodyPart part_of(const Vector3d& point, const Sections& sections, const SectionTags& tags, const Landmarks& limbs) {
  for (int side = 0; side < 2; ++side) {  // the shoulder's lower end, above the armpit
    const Limb* arm = limbs.arm(side);
    if (!arm || point.y() < arm->fork_y || arm->along(point) < 0) continue;
    if ((point - arm->root - arm->along(point) * arm->direction).norm() < kShoulder_m) return arm_part(side);
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
    if (arm && (point - arm->centres.back()).squaredNorm() < std::min(nearest, kFingers_m * kFingers_m) &&
        arm->along(point) > arm->length - kLastOfArm_m)
      part = static_cast<int>(arm_part(side));
  }
  return static_cast<BodyPart>(part);
}

Vector3d torso_middle(const Sections& sections, const SectionTrack& torso) {
  Vector3d sum = Vector3d::Zero();
  if (torso.loops.empty()) return sum;
  for (const auto& [level, loop] : torso.loops) sum += sections.levels[level][loop].centroid;
  return sum / static_cast<double>(torso.loops.size());
}

void take_heights(const TapeHeights& heights, Landmarks& marks) {
  marks.crotch_y = heights.crotch_y;
  marks.hip_y = heights.hip_y;
  marks.waist_y = heights.waist_y;
  marks.chest_y = heights.chest_y;
  marks.armpit_y = heights.armpit_y;
  marks.neck_y = heights.neck_y;
}

}  // namespace

Landmarks find_landmarks(const Mesh& mesh, const std::optional<Vector3d>& front_hint) {
  const Sections sections = horizontal_sections(mesh);
  const TaggedLimbs tagged = tagged_limbs(mesh, sections, front_hint);
  StandingBody body(mesh, {}, sections);
  Landmarks& marks = body.landmarks;
  static_cast<BodyLimbs&>(marks) = tagged.limbs;
  marks.stature = marks.top_y - marks.floor_y;
  const auto trunk =
      trunk_axis(body, marks.floor_y + kTrunkFrom * marks.stature, marks.floor_y + kTrunkTo * marks.stature);
  marks.axis = trunk ? *trunk : torso_middle(sections, tagged.torso);
  take_heights(tape_heights(body), marks);
  const auto whole = trunk_axis(body, marks.crotch_y, marks.armpit_y);
  marks.axis = whole.value_or(marks.axis);
  marks.has_trunk = trunk && whole;
  const SectionLoop* neck = body.trunk_loop(marks.neck_y);
  marks.neck = neck ? neck->centroid : Vector3d(marks.axis.x(), marks.neck_y, marks.axis.z());
  for (const Vector3i& t : mesh.triangles)
    marks.triangle_parts.push_back(
        part_of((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3, sections, tagged.tags, marks));
  return marks;
}

void require_known(const KnownBody& body, const std::string& where) {
  if (body.body.triangles.empty())
    throw InputError(where, "the body's mesh has no triangle; expected a closed body, the result of fuse");
  if (body.landmarks.triangle_parts.size() != body.body.triangles.size())
    throw InputError(where, "landmarks of " + std::to_string(body.landmarks.triangle_parts.size()) +
                                " triangles, found a body of " + std::to_string(body.body.triangles.size()) +
                                "; expected the result of landmarks for this body");
}

KnownBody known_body(Mesh body) {
  Landmarks landmarks = find_landmarks(body);
  return {std::move(body), std::move(landmarks)};
}

Landmarks transformed(const Landmarks& landmarks, const Eigen::Matrix4d& motion) {
  const Eigen::Matrix3d turn = motion.topLeftCorner<3, 3>();
  const Vector3d shift = motion.topRightCorner<3, 1>();
  Landmarks moved = landmarks;
  moved.front = turn * landmarks.front;
  moved.left = turn * landmarks.left;
  for (Vector3d* point : {&moved.neck, &moved.axis}) *point = turn * *point + shift;
  for (double* y : {&moved.floor_y, &moved.top_y, &moved.crotch_y, &moved.hip_y, &moved.waist_y, &moved.chest_y,
                    &moved.armpit_y, &moved.neck_y})
    *y += shift.y();
  for (auto* limb : {&moved.left_arm, &moved.right_arm, &moved.left_leg, &moved.right_leg}) {
    if (!*limb) continue;
    (*limb)->root = turn * (*limb)->root + shift;
    (*limb)->direction = turn * (*limb)->direction;
    (*limb)->fork_y += shift.y();
    for (Vector3d& centre : (*limb)->centres) centre = turn * centre + shift;
  }
  return moved;
}

Landmarks with_front(Landmarks landmarks, const Vector3d& front) {
  landmarks.front = front;
  landmarks.left = Vector3d::UnitY().cross(front);
  return landmarks;
}

}  // namespace dressform
