#pragma once
#include <cstdint>
#include <vector>

#include "pipeline/geometry/lattice.h"
#include "pipeline/surface/garment_cloud.h"

namespace dressform {

// Values with weights on a lattice.
struct LatticeData {
  std::vector<float> value;   // weighted mean
  std::vector<float> weight;  // 0: nothing known there
};

// Signed distance to the surface that oriented points lie on, near the points only: at each lattice point the weighted
// mean of the distances to the tangent planes around it (Shen, O'Brien and Shewchuk, SIGGRAPH 2004, without the far
// field). Tangential Gaussian of `sigma_m`, at most `reach_m` along the normal. Weight 1 = well supported.
LatticeData plane_distances(const Lattice& lattice, const GarmentCloud& cloud, double sigma_m, double reach_m);

// The smooth field e on the points of `domain` that follows the data where there is any and is harmonic in between:
// the minimum of  stiffness * sum w (e - value)^2 + sum over neighbours (e_i - e_j)^2,
// by red-black relaxation from coarse to fine. The result does not depend on the number of threads.
// `start`: continue from this field on the finest lattice only (empty: from nothing).
std::vector<float> diffuse(const Lattice& lattice, const LatticeData& data, const std::vector<std::uint8_t>& domain,
                           double stiffness, int sweeps, const std::vector<float>& start = {});

}  // namespace dressform
