#pragma once
#include <vector>

#include "pipeline/geometry/lattice.h"
#include "scenes/mesh.h"

namespace dressform {

// Takes head and neck, hands and feet out of the field (metres, negative inside) of a standing body's surface, with
// flat ends: the neck off where it widens to the shoulders, hands and feet by their part of the stature (Drillis and
// Contini, 1966). What the body's sections do not show stays. Whether anything was taken.
bool cut_ends(const Lattice& lattice, const Mesh& surface, std::vector<float>& field);

}  // namespace dressform
