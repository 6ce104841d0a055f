#pragma once
#include <string>
#include <vector>

#include "pipeline/body/body_limbs.h"

namespace dressform {

// What points of cloth (model frame) say of legs, height by height: a skirt spans the gap between them, trousers leave
// a gap or a valley there, on both sides as far as both are seen. The lower two thirds of the heights vote.
struct LegVotes {
  int spans = 0, parts = 0;  // heights below the crotch at which the cloth spans the legs, or leaves them apart
};
LegVotes leg_votes(const std::vector<Vector3d>& points, const BodyLimbs& limbs);

// "trousers" or "skirt" from points of the lower garment.
std::string bottom_kind(const std::vector<Vector3d>& points, const BodyLimbs& limbs);

// "dress" or "shirt" from points of the only garment, which covers the chest: a dress hangs well below the crotch.
std::string top_kind(const std::vector<Vector3d>& points, const BodyLimbs& limbs);

}  // namespace dressform
