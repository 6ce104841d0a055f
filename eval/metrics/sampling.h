#pragma once
#include <cstdint>
#include <vector>

#include "scenes/mesh.h"

namespace dressform::metrics {

// Points spread over a mesh, each standing for the same area.
struct SurfaceSamples {
  std::vector<Vector3d> points;
  std::vector<int> triangles;         // the one each point lies on
  std::vector<int> nearest_vertices;  // its corner with the largest barycentric weight
};

// Area-weighted, stratified and seeded: about one point per spacing_m squared, at least one on a mesh with area.
// Depends on (mesh, spacing, seed) only.
SurfaceSamples sample_surface(const Mesh& mesh, double spacing_m, std::uint64_t seed);

double surface_area(const Mesh& mesh);

// The q-quantile (0 to 1) by linear interpolation between order statistics; NaN of nothing.
double quantile(std::vector<double> values, double q);
// Pairwise sum divided by the count, so that a million small numbers keep their digits; NaN of nothing.
double mean(const std::vector<double>& values);

}  // namespace dressform::metrics
