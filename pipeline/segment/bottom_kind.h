#pragma once
#include <string>
#include <vector>

#include "pipeline/common/body_limbs.h"

namespace dressform {

// "trousers" or "skirt" from points of the lower garment (model frame). Below the crotch a skirt spans the gap between
// the legs, trousers leave a gap or a valley there; every height votes, a valley only where neither
// the front nor the back spans the gap.
struct LegVotes {
  int spans = 0, parts = 0;  // heights below the crotch at which the cloth spans the legs, or leaves them apart
};
LegVotes leg_votes(const std::vector<Vector3d>& points, const BodyLimbs& limbs);

std::string bottom_kind(const std::vector<Vector3d>& points, const BodyLimbs& limbs);

// "dress" or "shirt" from points of the only garment, which covers the chest: a dress hangs well below the crotch.
std::string top_kind(const std::vector<Vector3d>& points, const BodyLimbs& limbs);

}  // namespace dressform
