#pragma once
#include "pipeline/body/body_landmarks.h"
#include "scenes/mesh.h"

namespace dressform {

constexpr double kTubeAboveCrotch_m = 0.06;  // where the tube ends, within the trunk

// Closed tube of the convex hulls of both legs together, from `bottom_y` to a little above the crotch, outward: what a
// skirt goes round. Empty where there are no legs. Model frame, m.
Mesh leg_tube(const Mesh& body, const Landmarks& landmarks, double bottom_y);

}  // namespace dressform
