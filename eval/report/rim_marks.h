#pragma once
#include <string>
#include <vector>

#include "pipeline/open/open.h"
#include "scenes/mesh.h"

namespace dressform {

// A closed line as a thin tube, to be drawn on an edge. Empty for fewer than three points. `wanted`: which of the
// stretches from one point to the next are drawn; empty: all.
Mesh tube_along(const std::vector<Vector3d>& loop, double radius_m, const std::vector<char>& wanted = {});

// The rims of a garment as tubes: what some view saw of them, and what was carried on from what was seen.
struct RimMarks {
  Mesh seen, unseen;
};
RimMarks rim_marks(const OpenGarment& garment);

// What no view saw of the rims, in words for a caption: "No view saw the bottom's waist, 20 % of the top's neck: ...";
// empty where all was seen.
std::string unseen_rims_caption(const OpenGarments& opened);

}  // namespace dressform
