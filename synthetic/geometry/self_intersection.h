#pragma once
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// Number of pairs of triangles of a manifold mesh that meet elsewhere than at a common edge or vertex; exact predicates
// (CGAL).
long self_intersections(const Mesh& mesh);

// Triangles of a manifold mesh that meet another of its triangles elsewhere than at a common edge or vertex, or any
// triangle of `other` (of any kind); ascending, exact predicates.
std::vector<int> crossing_triangles(const Mesh& mesh, const Mesh& other);

}  // namespace dressform
