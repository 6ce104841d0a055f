#pragma once
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// Colours of a mesh's vertices by the nearest point of a coloured cloud, RGB 0-1; grey where none is within `reach_m`
// (thesis, section 3.4.2: so that a person sees where the cloth of a closed surface ends).
std::vector<Vector3f> rough_colors(const Mesh& mesh, const PointCloud& cloud, double reach_m);

}  // namespace dressform
