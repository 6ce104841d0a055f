#pragma once
#include <array>

#include "pipeline/body/body_limbs.h"
#include "scenes/mesh.h"

namespace dressform {

// The last place down each arm (left, right) where the garment encloses it all round: metres along the arm from the
// armpit, 0 where it does nowhere.
std::array<double, 2> sleeve_ends(const Mesh& garment, const BodyLimbs& limbs);

// For each triangle of the body, whether it belongs to an arm where the garment no longer encloses it (more than
// `margin_m` beyond the sleeve's end): such a triangle may lie beside the cloth, never inside it.
std::vector<char> exposed_arm_triangles(const Mesh& body, const BodyLimbs& limbs, const Mesh& garment, double margin_m);

}  // namespace dressform
