#pragma once
#include "scenes/mesh.h"

namespace dressform {

struct LayerParams {
  double gap_m = 0.003;   // of the outer garment from the inner one
  double reach_m = 0.05;  // inner cloth farther away is another place
  int rounds = 30;        // of lifting at most
  int fade_rounds = 4;    // rings of neighbours over which a lift fades
};

// The vertices of a garment worn over another one, lifted off it along the inner cloth's normals where they lie on it
// or under it. Both on one body, metres, outward; same triangles. Cloth beyond the inner garment's rims stays.
Mesh lifted_over(const Mesh& outer, const Mesh& inner, const LayerParams& params);

}  // namespace dressform
