#pragma once
#include <string>
#include <vector>

#include "pipeline/body/body_landmarks.h"
#include "scenes/mesh.h"

namespace dressform {

// One opening of a garment and the coordinates in which its rim is a function: `along` grows out of the garment,
// `angle` goes round. Tubes (cuffs, hems, ankles, waists) use a cylinder about the limb's axis; a neck uses the polar
// angle seen from inside the chest, because its rim runs over the flat of the shoulders.
struct Opening {
  enum class Shape { cylinder, polar };
  std::string name;  // "neck", "left_cuff", "right_cuff", "hem", "waist", "left_ankle", "right_ankle"
  Shape shape = Shape::cylinder;
  BodyPart limb = BodyPart::torso;  // that the opening is the end of: an arm or a leg, else the torso
  Vector3d centre = Vector3d::Zero();
  Vector3d axis = Vector3d::UnitY();  // unit, out of the garment
  Vector3d zero = Vector3d::UnitX();  // direction of angle 0, unit, across the axis

  double along(const Vector3d& point) const;  // metres; polar: arc on a sphere of kPolarRadius_m about the centre
  double angle(const Vector3d& point) const;  // radians, -pi to pi
};

constexpr double kPolarRadius_m = 0.15;

// The openings that a garment of this kind has on this body ("shirt", "dress": neck, cuffs, hem; "trousers": waist,
// ankles; "skirt": waist, hem), roughly placed by the closed mesh. Empty when the body lacks the limbs for it, and for
// a kind that is not known. `parts`: of the body, below the vertices of the mesh.
std::vector<Opening> garment_openings(const std::string& kind, const Mesh& closed, const std::vector<BodyPart>& parts,
                                      const Landmarks& landmarks);

// Whether a point over this part of the body can be of the cloth that the opening ends.
bool belongs(const Opening& opening, BodyPart part, const Vector3d& point, const Landmarks& landmarks);

// Which opening an edge point of the garment belongs to: by the part of the body below it, and its height. Null for
// none.
const Opening* opening_near(const std::vector<Opening>& openings, const Vector3d& point, BodyPart part,
                            const Landmarks& limbs);

}  // namespace dressform
