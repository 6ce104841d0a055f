#pragma once
#include <optional>
#include <string>
#include <vector>

#include "pipeline/body/body_limbs.h"
#include "pipeline/registration/registration.h"
#include "scenes/capture_session.h"

namespace dressform {

// One opening of a garment and the coordinates in which its rim is a function: `along` grows out of the garment,
// `angle` goes round. Tubes (cuffs, hems, ankles, waists) use a cylinder about the limb's axis; a neck uses the polar
// angle seen from inside the chest, because its rim runs over the flat of the shoulders.
struct Opening {
  enum class Shape { cylinder, polar };
  std::string name;  // "neck", "left_cuff", "right_cuff", "hem", "waist", "left_ankle", "right_ankle"
  Shape shape = Shape::cylinder;
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
                                      const BodyLimbs& limbs);

// "trousers" where a bottom's closed surface comes apart into two legs below the crotch, "skirt" where it stays one;
// `otherwise` where it does either or ends too soon to tell.
std::string closed_bottom_kind(const Mesh& closed, const BodyLimbs& limbs, const std::string& otherwise);

// Which opening an edge point of the garment belongs to: by the part of the body below it, and its height. Null for
// none.
const Opening* opening_near(const std::vector<Opening>& openings, const Vector3d& point, BodyPart part,
                            const BodyLimbs& limbs);

// The direction the body faces, from the rig prior (the world faces +z); absent without one.
std::optional<Vector3d> front_from_prior(const CaptureSession& session, const Registration& registration);

}  // namespace dressform
