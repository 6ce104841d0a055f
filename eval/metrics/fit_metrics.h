#pragma once
#include <cstdint>
#include <vector>

#include "scenes/mesh.h"

namespace dressform::metrics {

// How deep a garment lies inside a closed body. Depths are max(0, -signed distance) at area-weighted seeded samples;
// the sign is the winding number's.
struct Penetration {
  double area_cm2 = 0;                         // of the garment that is more than 1 mm inside
  double mean_mm = 0, p95_mm = 0, max_mm = 0;  // over the whole garment
  int components_inside = 0;  // components of which one vertex lies inside: with no intersecting pair, the proof
  long samples = 0;
};
Penetration penetration(const Mesh& garment, const Mesh& body, double spacing_m = 0.004, std::uint64_t seed = 1);

// 95th percentile of |length after / length before - 1| over the edges of two meshes with the same triangles.
// Throws std::invalid_argument when the triangles differ.
double edge_stretch_p95(const Mesh& before, const Mesh& after);

}  // namespace dressform::metrics
