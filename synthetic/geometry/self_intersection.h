#pragma once
#include "scenes/mesh.h"

namespace dressform {

// Number of pairs of triangles of a manifold mesh that meet elsewhere than at a common edge or vertex; exact predicates
// (CGAL).
long self_intersections(const Mesh& mesh);

}  // namespace dressform
