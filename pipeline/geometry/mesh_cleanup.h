#pragma once
#include "scenes/mesh.h"

namespace dressform {

// The closed mesh with edges shorter than `shortest_m` collapsed to their mid-points and the vertices evened out along
// the surface. Same topology; a mesh that is not closed and manifold comes back as it is.
Mesh edge_collapsed(const Mesh& mesh, double shortest_m);

// Moves vertices towards the middle of their neighbours, along the surface only. Boundary vertices stay.
Mesh tangentially_smoothed(const Mesh& mesh, int rounds);

}  // namespace dressform
