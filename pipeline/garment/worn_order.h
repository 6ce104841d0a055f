#pragma once
#include "pipeline/garment/garment_layout.h"
#include "pipeline/geometry/mesh_query.h"
#include "scenes/mesh.h"

namespace dressform {

// How top and bottom lie to one another: where their points meet round the body, the outer one's lie further off it.
struct WornOrder {
  Worn top = Worn::alone;  // under: tucked in
  double sure = 0;         // 0-1: part of the directions that agree, beyond a half
};
// Where nothing says that the top is tucked in it hangs over the bottom, as cloth does; `alone` where either is empty.
WornOrder worn_order(const PointCloud& top, const PointCloud& bottom, const MeshQuery& naked,
                     const Landmarks& landmarks);

}  // namespace dressform
