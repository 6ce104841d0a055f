#pragma once
#include <array>
#include <vector>

#include "pipeline/body/standing_body.h"
#include "pipeline/garment/garment_layout.h"

namespace dressform {

// Which of two neighbouring parts of the body each vertex of a garment goes round: 1 the one, -1 the other, 0 neither
// or both. Told by the garment's own shape, below the height where it parts: cloth between two parts of the body lies
// as near to the one as to the other.
using ClothSides = std::vector<signed char>;

struct ClothLimbs {
  ClothSides legs;                 // 1 left, -1 right; 0 throughout for what does not part (shirts, skirts)
  std::array<ClothSides, 2> arms;  // of the left and right arm: 1 the sleeve, -1 the rest below where the two part
};
// `layout`: of the garment on its wearer, which says what parts at all.
ClothLimbs limbs_of_cloth(const Mesh& garment, const GarmentLayout& layout, const StandingBody& wearer);

// The fitted garment's vertices with cloth of either side kept `gap_m` off the surface midway between the user's legs,
// and between each arm and the rest: what touches presses the cloth between it flat, and a garment never passes through
// itself there. Cloth that is on its own side stays.
std::vector<Vector3d> limbs_kept_apart(const Mesh& fitted, const ClothLimbs& limbs, const StandingBody& user,
                                       const MeshQuery& user_surface, double gap_m);

}  // namespace dressform
