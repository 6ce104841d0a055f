#pragma once
#include <vector>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/body/standing_body.h"
#include "pipeline/geometry/mesh_query.h"

namespace dressform {

// A place on the naked body and the place on the user that it should move to, both in their own model frames.
struct ControlPair {
  Vector3d control = Vector3d::Zero(), target = Vector3d::Zero();
  BodyPart part = BodyPart::torso;
};

struct ControlPairParams {
  int trunk_levels = 14, trunk_angles = 16, limb_levels = 8, limb_angles = 8;
};

// Pairs at the same part of the way between landmarks and the same direction: rings of rays from the trunk's axis (the
// directions scaled by breadth and depth, so that an ellipse goes to an ellipse), from the axes of the legs and of the
// arms, and of the head. Rays that miss, or that hit an arm where it lies against the trunk, give no pair.
std::vector<ControlPair> landmark_pairs(const StandingBody& naked, const MeshQuery& naked_surface,
                                        const StandingBody& user, const MeshQuery& user_surface,
                                        const ControlPairParams& params);

}  // namespace dressform
