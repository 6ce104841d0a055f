#pragma once
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// Joins a boundary loop of the mesh (as boundary_loops gives it) to the points a person picked along the rim, in order
// and closed, in either direction: they become vertices, and the new boundary. As in section 3.4.2 of the thesis: every
// picked point a(i) has a nearest boundary vertex e(i) and makes a triangle with it and a(i+1), and so do the boundary
// edges between e(i) and e(i+1) with a(i+1): all of them from e(i) on, where the thesis's text starts at the first one
// of the loop. Nearest is meant under the condition that the e(i) follow one another round the loop, without which the
// strip folds: the least sum of squared distances. Throws std::invalid_argument for fewer than three points or
// vertices.
void stitch(Mesh& mesh, std::vector<int> boundary, std::vector<Vector3d> picked);

}  // namespace dressform
