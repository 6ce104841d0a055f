#pragma once
#include <vector>

#include "pipeline/geometry/lattice.h"

namespace dressform {

// The piece of most triangles, joined by vertices; vertices that no triangle uses are left out.
Mesh largest_component(const Mesh& mesh);

// Closed, manifold, one piece, no handles.
bool ball_shaped(const Mesh& mesh);

// The lattice about a mesh that has vertices, with six steps on every side.
Lattice lattice_round(const Mesh& mesh, double step_m);

// Signed distance to the mesh, negative inside. Sides far from the mesh are told apart by what can be reached from the
// border without coming near it; far from it, where nobody looks, the distance is a constant.
std::vector<float> distance_field(const Mesh& mesh, const Lattice& lattice);

// The solid without handles and hollows nearest to the field (negative inside) that came from `mesh`; vertices that the
// lattice moved a little are the mesh's own. Empty where nothing is inside.
Mesh ball_like(const Mesh& mesh, const Lattice& lattice, std::vector<float> distances);

}  // namespace dressform
