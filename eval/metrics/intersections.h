#pragma once
#include "scenes/mesh.h"

namespace dressform::metrics {

// Number of pairs of a triangle of `a` and a triangle of `b` that share a point, decided by exact predicates (CGAL) on
// the coordinates as they are. Touching counts. Triangles without area count by their longest side.
long intersecting_pairs(const Mesh& a, const Mesh& b);

}  // namespace dressform::metrics
