#pragma once
#include <vector>

#include "pipeline/body/standing_body.h"
#include "pipeline/fit/control_pairs.h"
#include "pipeline/fit/rbf_field.h"
#include "pipeline/fit/space_map.h"

namespace dressform {

struct BodyWarpParams {
  ControlPairParams pairs;
  RbfField::Kernel kernel = RbfField::Kernel::linear;
  double smoothing = 0.02;
  double radius_m = 0.3;          // of kernels that fall off
  int rounds = 2;                 // of snapping the warped body to the user's surface
  double snap_spacing_m = 0.06;   // between the body's points that are snapped
  double snap_distance_m = 0.04;  // further is not the same place
  double snap_angle_deg = 60;     // between the normals
};

// Places on the user for places on the naked body. Landmark pairs first; then points spread over the naked body are
// warped by radial basis functions, snapped to the user's surface where normals agree and the snap is mutual, and
// added.
std::vector<ControlPair> body_pairs(const StandingBody& naked, const MeshQuery& naked_surface, const StandingBody& user,
                                    const MeshQuery& user_surface, const BodyWarpParams& params);

// Maps from the naked body's space to the user's: one held by all controls, one without those of the arms. Hands hang
// beside skirts and hems, but must not drag them along.
struct BodyWarp {
  SpaceMap all, core;
  int control_points = 0;
};
BodyWarp warp_through(const std::vector<ControlPair>& pairs, const MakeMap& make);

// By radial basis functions through the body's pairs.
BodyWarp warp_body(const StandingBody& naked, const MeshQuery& naked_surface, const StandingBody& user,
                   const MeshQuery& user_surface, const BodyWarpParams& params);

// The naked body's vertices moved: those of the arms by `all`, others by `core`, blended across the shoulders.
Mesh warped_body(const StandingBody& naked, const BodyWarp& warp);

// How much the map of all controls counts at each vertex (1 on the arms), spread over `rounds` rings of neighbours.
std::vector<double> diffused_weights(const Mesh& mesh, std::vector<double> weights, int rounds);

}  // namespace dressform
