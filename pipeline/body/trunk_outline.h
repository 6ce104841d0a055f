#pragma once
#include <vector>

#include "pipeline/body/sections.h"

namespace dressform {

// A horizontal section told apart into trunk and arms. An arm that touches the trunk, or is joined to it by a web of
// the scan's surface, is cut off where the section is thinnest between the two.
struct TrunkOutline {
  SectionLoop trunk;                         // centroid and area of the loop before the cut
  std::vector<std::vector<Vector3d>> limbs;  // all the rest
  double joint = 0;                          // thickness at a cut over the trunk's, the thicker one; 0: none
};

// `middle`: a point on the trunk's axis; `left`: unit, across the body. Empty where the level has no loop.
TrunkOutline trunk_outline(const std::vector<SectionLoop>& loops, const Vector3d& middle, const Vector3d& left,
                           double stature);

// Distance of a point to a closed line, in the horizontal plane, m.
double horizontal_distance(const Vector3d& point, const std::vector<Vector3d>& line);

}  // namespace dressform
