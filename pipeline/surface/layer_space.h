#pragma once
#include <cstdint>
#include <vector>

#include "pipeline/geometry/lattice.h"
#include "pipeline/surface/covered_body.h"
#include "scenes/mesh.h"

namespace dressform {

// A lattice with, at each point, the distance to the covered body: exact near it, interpolated elsewhere.
struct LayerSpace {
  Lattice lattice;
  std::vector<float> body_distance;
  std::vector<std::uint8_t> domain;  // where the surface can be
};

// The space round the covered body and the cloud, `reach_m` beyond the points. Metres.
LayerSpace make_space(const CoveredBody& body, const PointCloud& cloud, double step_m, double reach_m);

}  // namespace dressform
