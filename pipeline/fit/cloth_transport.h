#pragma once
#include <vector>

#include "pipeline/fit/body_warp.h"
#include "pipeline/garment/garment_layout.h"

namespace dressform {

struct ClothTransportParams {
  double keep_offset = 1;     // 0: the map alone; 1: every point keeps its distance from the body
  double near_m = 0.06;       // beyond this distance from the body its surface says less about where cloth goes
  int diffusion_rounds = 40;  // of the change against the map alone, over rings of neighbours
};

// The garment on the user. A point of cloth is the nearest point of the naked body and an offset: the map
// takes the body's point to the user, where it is put on the surface, and the offset keeps its length as far as there
// is room before another part of the body, so that the difference between the girths of cloth and body stays. The
// change against the map alone is diffused over the cloth, because nearest points jump between legs and under arms.
// Sleeves follow the arms as far as they enclose them.
struct Transported {
  std::vector<Vector3d> vertices;
  std::vector<double> sleeve;  // per vertex, 0 on trunk and legs to 1 on sleeves
};
Transported transported(const Mesh& garment, const GarmentLayout& layout, const StandingBody& naked,
                        const BodyWarp& warp, const MeshQuery& user_surface, const ClothTransportParams& params);

}  // namespace dressform
