#pragma once
#include <vector>

#include "pipeline/geometry/lattice.h"
#include "scenes/mesh.h"

namespace dressform {

// Keeps a standing body's legs `gap_m` apart in the field (metres, negative inside) of its surface, from the knees up
// to where thighs that only touch end. A scan sees the slit between thighs at grazing angles or not at all, so that the
// surface closed over it comes out narrow or webbed; and trousers part thighs that do touch. Nothing is taken where the
// legs are further apart, or not found. Whether anything was taken.
bool part_thighs(const Lattice& lattice, const Mesh& surface, double gap_m, std::vector<float>& field);

}  // namespace dressform
