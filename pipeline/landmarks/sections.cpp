// Landmarks from the horizontal sections of the body: topology and girths. Feet tell the front where there are feet,
// the rig's prior where there are none; the user faces as the mannequin does.
#include <cmath>

#include "pipeline/landmarks/landmarks.h"
#include "pipeline/landmarks/likeness.h"
#include "scenes/error.h"

namespace dressform {
namespace {

struct SectionsParams {
  double feet_m = 0.01;  // what find_limbs asks of feet to tell the front at all; people's reach over 30 mm
};
template <class V>
void fields(V& v, SectionsParams& p) {
  v("feet_m", p.feet_m, 0.0, 0.3, "m",
    "feet that reach this far beyond the ankles tell the front themselves, whatever the rig's prior says");
}

// A mannequin may stand the other way round than the rig's prior has it: its own feet are believed first.
Landmarks by_feet_or_rig(const Mesh& body, const std::optional<Vector3d>& rig_front, const SectionsParams& params) {
  Landmarks own = find_landmarks(body);
  const bool feet = own.front_from == FrontFrom::feet && own.feet_forward_m >= params.feet_m;
  const bool agree = rig_front && own.left_leg && own.right_leg && rig_front->dot(own.front) > 0;
  if (rig_front && !agree && !feet) {
    own = find_landmarks(body, rig_front);
    own.sure = own.front_from == FrontFrom::rig;
    return own;
  }
  if (agree && !feet) own.front_from = FrontFrom::rig;
  own.sure = agree || (feet && !rig_front);
  return own;
}

// The two may have been taken for one another's back: beyond a quarter turn left and right change places, and the limbs
// are told again.
Landmarks faced_like(const KnownBody& known, const Mesh& body) {
  Landmarks own = find_landmarks(body);
  const Likeness alike = likeness(StandingBody(known), StandingBody({body, own}));
  const Vector3d front = own.direction(alike.turn_rad);
  if (std::abs(std::remainder(alike.turn_rad, 2 * M_PI)) > M_PI / 2) own = find_landmarks(body, front);
  own = with_front(std::move(own), front);
  own.front_from = FrontFrom::likeness;
  own.sure = alike.sure && known.landmarks.sure;
  return own;
}

Landmarks sections(const BodyModel& model, const FacingClues& clues, const SectionsParams& params) {
  if (model.body.triangles.empty())
    throw InputError("landmarks.sections", "the body has no triangle; expected a closed body, the result of fuse");
  return clues.like ? faced_like(*clues.like, model.body) : by_feet_or_rig(model.body, clues.rig_front, params);
}

const FindLandmarks::Variant sections_variant{"sections", sections};

}  // namespace
}  // namespace dressform
