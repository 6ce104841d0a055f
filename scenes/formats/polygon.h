#pragma once
#include <array>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// Adds the triangles of a polygon to `triangles`, as numbers of its corners, turning as the polygon turns. Corners in
// order, metres; 3 at least. Concave polygons, and those with repeated or collinear corners, are filled where they
// are; a polygon on one line becomes a fan of no area. Returns false, and adds nothing, where the outline crosses
// itself.
bool triangulate(const std::vector<Vector3d>& corners, std::vector<std::array<int, 3>>& triangles);

}  // namespace dressform
