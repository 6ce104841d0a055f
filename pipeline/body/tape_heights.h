#pragma once
#include "pipeline/body/standing_body.h"

namespace dressform {

// m over the model frame's origin: the heights at which a tailor measures, by the girths of the trunk without the arms.
// Of `body.landmarks` the limbs, stature and axis have to be known.
struct TapeHeights {
  double crotch_y = 0, hip_y = 0, waist_y = 0, chest_y = 0, armpit_y = 0, neck_y = 0;
};
TapeHeights tape_heights(const StandingBody& body);

// Mean of the trunk's centroids over the heights from `low` to `high`; absent where there is no trunk.
std::optional<Vector3d> trunk_axis(const StandingBody& body, double low, double high);

}  // namespace dressform
