#pragma once
#include <functional>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// The same open surface with triangles of about one size (Botsch and Kobbelt, "A remeshing approach to multiresolution
// modeling", SGP 2004; CGAL). Boundaries and the edges between triangles of different `piece` (one per triangle) stay
// where they are, divided anew. The input must be manifold. Same bytes for the same input.
Mesh even_mesh(const Mesh& mesh, const std::vector<int>& piece, double edge_m);

}  // namespace dressform
