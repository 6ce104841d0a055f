#pragma once
#include <string>
#include <vector>

#include "pipeline/open/open.h"
#include "scenes/mesh.h"

namespace dressform {

// A closed line as a thin tube, to be drawn on an edge. Empty for fewer than three points.
Mesh tube_along(const std::vector<Vector3d>& loop, double radius_m);

// The rims of a garment as tubes: those that some view saw, and those that were carried on from what was seen.
struct RimMarks {
  Mesh seen, unseen;
};
RimMarks rim_marks(const OpenGarment& garment);

// The rims that no view saw, in words for a caption: "No view saw the bottom's waist."; empty where all were seen.
std::string unseen_rims_caption(const OpenGarments& opened);

}  // namespace dressform
