#pragma once
#include <string>
#include <vector>

#include "pipeline/common/body_limbs.h"

namespace dressform {

// "trousers" or "skirt" from points of the lower garment (model frame). Below the crotch a skirt spans the gap between
// the legs, trousers leave a gap or a valley there; every height votes, a valley only where neither
// the front nor the back spans the gap.
std::string bottom_kind(const std::vector<Vector3d>& points, const BodyLimbs& limbs);

}  // namespace dressform
