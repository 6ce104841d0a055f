#pragma once
#include <array>
#include <vector>

#include "pipeline/garment/garment_layout.h"
#include "scenes/mesh.h"

namespace dressform {

// The last place down each arm (left, right) where the garment encloses it all round: metres along the arm from the
// armpit, 0 where it does nowhere.
std::array<double, 2> sleeve_ends(const Mesh& garment, const Landmarks& landmarks);

// The layout with its sleeves ending where those of an open garment do, on the body that wears it. What is no top has
// none.
GarmentLayout with_sleeve_ends(GarmentLayout layout, const Mesh& garment, const Landmarks& landmarks);

// For each triangle of the body, whether it belongs to an arm where the garment no longer encloses it (more than
// `margin_m` beyond the sleeve's end): such a triangle may lie beside the cloth, never inside it.
std::vector<char> exposed_arm_triangles(const KnownBody& body, const GarmentLayout& layout, double margin_m);

}  // namespace dressform
