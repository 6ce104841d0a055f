#pragma once
#include <vector>

#include "pipeline/registration/model_alignment.h"

namespace dressform {

struct InitialPoseOptions {
  int headings = 36;              // starts of every view, evenly round the circle
  double prior_reach_deg = 50;    // a view may turn this far from where the rig prior puts it relative to the others
  double contradiction_m = 0.06;  // seen behind the model by more than this speaks against a pose
};

// A rough pose of every usable view. Each view is tried from all sides: its floor fixes pitch, roll and height, its
// mannequin the place, so that only the heading is open. With a rig prior the views then agree on one heading of the
// model, judged by the residuals of all of them together; without one every view decides for itself.
std::vector<ViewAlignment> initial_poses(const std::vector<ViewPoints>& views, const ModelTarget& target,
                                         const InitialPoseOptions& options);

}  // namespace dressform
