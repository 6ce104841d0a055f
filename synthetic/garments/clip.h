#pragma once
#include <functional>

#include "scenes/mesh.h"

namespace dressform {

using Level = std::function<double(const Vector3d&)>;

// Splits the triangles along the level's zero, so that no triangle lies on both sides; vertices close to the zero are
// moved onto it first, along an edge, so that no sliver arises. Returns the value at every vertex, exactly 0 on the
// cut.
std::vector<double> split_along(Mesh& mesh, const Level& level);

// What lies where the level is negative, cut off exactly at zero.
Mesh cut_off(Mesh mesh, const Level& level);

// The connected part with most triangles.
Mesh largest_part(const Mesh& mesh);

}  // namespace dressform
