#pragma once
#include <optional>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/fuse/fuse.h"
#include "pipeline/registration/registration.h"
#include "pipeline/run/stage.h"
#include "scenes/capture_session.h"

namespace dressform {

// What beside its own shape tells which way a body faces. A scan's heading means nothing, and a body seen from behind
// has its front where another's back is.
struct FacingClues {
  std::optional<Vector3d> rig_front;  // horizontal, unit, model frame: where the rig's prior has the mannequin face
  std::optional<KnownBody> like;      // the mannequin, for the user, who stands much as it does
};

struct LandmarksTag {
  static constexpr const char* name = "landmarks";
  static constexpr const char* default_variant = "sections";
};
// Body landmarks, the axes of the limbs, the part of the body that every triangle is of, and front, left and right:
// all later stages go by these and find none of them again. In: a closed body, y up, floor y = 0, m, model frame. Out:
// m, model frame of that body. Of the mannequin it stands after registration, because only registered views carry the
// rig's prior into the model's frame; of the user after the mannequin's, to face alike.
// Throws InputError for a body without triangles. What is not found is absent, or flagged: has_trunk, sure.
// Paper: Zhong and Xu, "Automatic segmenting and measurement on scanned human body", International Journal of Clothing
// Science and Technology 18(1), 2006 (sections, their topology and girths); bounds from ANSUR II (Gordon et al. 2014).
using FindLandmarks = Stage<LandmarksTag, Landmarks(const BodyModel& body, const FacingClues& clues)>;

// The direction the body faces by the rig's prior (the world faces +z) and the registered views, mean over the views:
// horizontal, unit, model frame. Absent without a prior, or where the views contradict one another.
std::optional<Vector3d> front_from_rig(const std::optional<RigPrior>& prior, const Registration& registration);

}  // namespace dressform
