#pragma once
#include <array>
#include <optional>
#include <vector>

#include "pipeline/body/sections.h"
#include "scenes/mesh.h"

namespace dressform {

enum class BodyPart : unsigned char { torso, head, left_arm, right_arm, left_leg, right_leg };
inline bool is_arm(BodyPart part) { return part == BodyPart::left_arm || part == BodyPart::right_arm; }
inline bool is_leg(BodyPart part) { return part == BodyPart::left_leg || part == BodyPart::right_leg; }
inline BodyPart arm_part(int side) { return side == 0 ? BodyPart::left_arm : BodyPart::right_arm; }
inline BodyPart leg_part(int side) { return side == 0 ? BodyPart::left_leg : BodyPart::right_leg; }
// 0 left, 1 right, of an arm or a leg.
inline int side_of(BodyPart limb) { return limb == BodyPart::left_arm || limb == BodyPart::left_leg ? 0 : 1; }

// An arm or a leg: a straight axis from where it leaves the torso to its end. Metres, model frame.
struct Limb {
  Vector3d root = Vector3d::Zero();       // a point of the axis at the height of the armpit or crotch
  Vector3d direction = Vector3d::Zero();  // unit, away from the torso
  double length = 0;                      // from the root to the fingers or toes
  double fork_y = 0;                      // height of the armpit or crotch
  std::vector<Vector3d> centres;          // section centroids from the root on, 1 cm apart in height

  double along(const Vector3d& point) const { return (point - root).dot(direction); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(root, direction, length, fork_y, centres);
  }
};

// What told the front of a body.
enum class FrontFrom : unsigned char {
  nothing,   // neither of the others: +z, or either side of the legs
  feet,      // they point forward
  rig,       // where the rig's prior has the mannequin face
  likeness,  // the outlines of another body whose front is known
};

// What the topology of the horizontal sections of a standing body says of its limbs. Metres, model frame, y up. Left
// and right are the body's own.
struct BodyLimbs {
  Vector3d front = Vector3d::UnitZ(), left = Vector3d::UnitX();  // horizontal unit vectors
  FrontFrom front_from = FrontFrom::nothing;
  double feet_forward_m = 0;          // by which the feet reach beyond the ankles, along the front
  double floor_y = 0, top_y = 0;      // lowest and highest section
  double crotch_y = 0, armpit_y = 0;  // armpit: the higher one; where there are arms
  std::optional<Limb> left_arm, right_arm, left_leg, right_leg;

  const Limb* arm(int side) const;  // 0 left, 1 right; null where there is none
  const Limb* leg(int side) const;
  Vector3d outwards(int side) const { return side == 0 ? left : Vector3d(-left); }  // away from the body's middle
  Vector3d hips() const { return (left_leg->root + right_leg->root) / 2; }          // middle of the legs, both known
};

// Limbs by the topology of the sections: two legs join at the crotch going up, arms join the torso at the armpits. The
// front is where `front_hint` points when it is given, else where the feet do; where legs tell the sideways direction,
// only its sign is used. Limbs that the sections do not show apart are absent. This looks at a mesh alone: what the
// stages go by is the result of the landmarks stage. Throws InputError for a mesh without triangles.
BodyLimbs find_limbs(const Mesh& body, const std::optional<Vector3d>& front_hint = {});
// The same, with the body's horizontal_sections at hand.
BodyLimbs find_limbs(const Mesh& body, const Sections& sections, const std::optional<Vector3d>& front_hint = {});

}  // namespace dressform
