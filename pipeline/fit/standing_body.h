#pragma once
#include <optional>
#include <vector>

#include "pipeline/body/body_limbs.h"
#include "pipeline/fit/trunk_outline.h"
#include "pipeline/geometry/mesh_query.h"
#include "scenes/mesh.h"

namespace dressform {

// A body with what its sections say: the heights that correspond between people, and the trunk's outline.
struct StandingBody {
  Mesh mesh;
  Sections sections;
  BodyLimbs limbs;
  double stature = 0;
  // Landmark heights, m. Found by topology and girth, and held within what people are like (ANSUR II): thighs that
  // touch hide the crotch, a belly hides the waist.
  double crotch_y = 0, hip_y = 0, waist_y = 0, chest_y = 0, armpit_y = 0, neck_y = 0;
  Vector3d axis = Vector3d::Zero();  // a point on the trunk's axis (x and z matter)

  // Direction at `angle` about the vertical, 0 = front, a quarter turn = left.
  Vector3d direction(double angle) const { return std::cos(angle) * limbs.front + std::sin(angle) * limbs.left; }
  const SectionLoop* trunk_loop(double y) const;  // the largest loop of the level; null where there is none
  TrunkOutline outline_at(double y) const;        // of the level; empty where there is none
};

// Height at part t of the way along the marks (at least two): 0 the first, 1 the second; in between linear.
double height_at(const std::vector<double>& marks, double t);

StandingBody analyse_body(const Mesh& mesh, const std::optional<Vector3d>& front_hint = {});

// The user with `front` and `left` turned to agree with the naked body's, whatever the headings of the two scans: the
// turn at which the outlines agree best over all heights (the feet point forward, the seat backward), then refined on
// the trunk alone. `confident` is false where the two best turns are nearly as good as one another.
struct FacingUser {
  StandingBody user;
  double turn_deg = 0;  // from the front that the user's feet and legs gave
  bool confident = false;
};
FacingUser face_alike(const StandingBody& naked, const Mesh& user);

// Girth of the convex hull of a loop, m: what a tape measures.
double tape_girth(const SectionLoop& loop);

}  // namespace dressform
