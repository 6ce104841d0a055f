#pragma once
#include <vector>

#include "scenes/picks.h"

namespace dressform {

// One closed, ordered loop (model frame, metres) from what was picked round one rim. A single part in the frame "model"
// is taken in its own order. Several parts, each what one sensor saw of the rim, are put in order by the angle about
// the loop's axis; points of two parts that lie closer than half their usual spacing become one, and gaps that nobody
// saw are bridged at the angles between, with radius and height that change evenly. Parts in other frames are left out.
// May have fewer than three points.
std::vector<Vector3d> picked_loop(const std::vector<PickedPoints>& parts);

// Normal of a closed loop, seen from whose tip it runs counter-clockwise, as long as twice the area it encloses.
Vector3d doubled_area(const std::vector<Vector3d>& loop);

// Area of the flat-most surface in a closed loop, square metres.
double enclosed_area_m2(const std::vector<Vector3d>& loop);

}  // namespace dressform
