#pragma once
#include <array>
#include <optional>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// One closed curve of a horizontal section, x and z of its points; counter-clockwise seen from below (x to z).
struct SectionLoop {
  std::vector<Vector3d> points;
  Vector3d centroid = Vector3d::Zero();
  double area_m2 = 0;
};

// Sections of a closed mesh with the planes y = first_y + i step, outer loops only, largest area first.
struct Sections {
  double first_y = 0, step = 0.01;
  std::vector<std::vector<SectionLoop>> levels;

  double y(int level) const { return first_y + level * step; }
  int level(double height) const;  // the nearest one that exists; -1 if there is none
};
Sections horizontal_sections(const Mesh& mesh, double step_m = 0.01);

// Whether (x, z) of the point lies inside the loop.
bool contains(const SectionLoop& loop, const Vector3d& point);

enum class BodyPart : unsigned char { torso, head, left_arm, right_arm, left_leg, right_leg };
inline bool is_arm(BodyPart part) { return part == BodyPart::left_arm || part == BodyPart::right_arm; }
inline bool is_leg(BodyPart part) { return part == BodyPart::left_leg || part == BodyPart::right_leg; }

// An arm or a leg: a straight axis from where it leaves the torso to its end.
struct Limb {
  Vector3d root = Vector3d::Zero();       // a point of the axis at the height of the armpit or crotch
  Vector3d direction = Vector3d::Zero();  // unit, away from the torso
  double length = 0;                      // from the root to the fingers or toes
  double fork_y = 0;                      // height of the armpit or crotch
  std::vector<Vector3d> centres;          // section centroids from the root on, 1 cm apart in height

  double along(const Vector3d& point) const { return (point - root).dot(direction); }
};

// What the horizontal sections of a standing body say of its limbs. Left and right are the body's own.
struct BodyLimbs {
  Vector3d front = Vector3d::UnitZ(), left = Vector3d::UnitX();  // horizontal unit vectors
  double floor_y = 0, top_y = 0;
  double crotch_y = 0, waist_y = 0, neck_y = 0, armpit_y = 0;  // armpit: the higher one; where there are arms
  Vector3d neck = Vector3d::Zero();                            // centre of the neck's section
  std::optional<Limb> left_arm, right_arm, left_leg, right_leg;
  std::vector<BodyPart> triangle_parts;  // of the mesh's triangles

  const Limb* arm(int side) const;  // 0 left, 1 right; null where there is none
  const Limb* leg(int side) const;
  Vector3d outwards(int side) const { return side == 0 ? left : Vector3d(-left); }  // away from the body's middle
  Vector3d hips() const { return (left_leg->root + right_leg->root) / 2; }          // middle of the legs, both known
  // Of one of the mesh's triangles; of none (-1), the torso.
  BodyPart part_of(int triangle) const { return triangle < 0 ? BodyPart::torso : triangle_parts[triangle]; }
};

// Limbs by the topology of the sections: two legs join at the crotch going up, arms join the torso at the armpits, the
// neck is the narrowest section above. The front is where the feet point, or `front_hint` when it is given (only its
// sign is used where the legs tell the sideways direction). Limbs that the sections do not show apart are absent.
// Throws InputError for a mesh without triangles.
BodyLimbs find_limbs(const Mesh& body, const std::optional<Vector3d>& front_hint = {});
// The same, with the body's horizontal_sections at hand.
BodyLimbs find_limbs(const Mesh& body, const Sections& sections, const std::optional<Vector3d>& front_hint = {});

}  // namespace dressform
