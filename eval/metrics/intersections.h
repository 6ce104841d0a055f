#pragma once
#include "scenes/mesh.h"

namespace dressform::metrics {

// Number of pairs of a triangle of `a` and a triangle of `b` that share a point, decided by exact predicates (CGAL) on
// the coordinates as they are. Touching counts. Triangles without area count by their longest side.
long intersecting_pairs(const Mesh& a, const Mesh& b);

// Number of pairs of triangles of one mesh that share a point which is not of a vertex that both have; exact as above.
// Two triangles with a common side are left out: they can only fold onto one another.
long self_intersecting_pairs(const Mesh& mesh);

}  // namespace dressform::metrics
