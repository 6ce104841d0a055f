#pragma once
#include "pipeline/body/body_limbs.h"
#include "pipeline/geometry/mesh_query.h"
#include "scenes/mesh.h"

namespace dressform {

// Whether the top is worn under the bottom: where their points meet round the body, those of the bottom lie further off
// it. False where they do not meet, or lie alike.
bool is_tucked(const PointCloud& top, const PointCloud& bottom, const MeshQuery& naked, const BodyLimbs& limbs);

}  // namespace dressform
