#pragma once
#include <array>
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// Two features of cloth that come close: a vertex and a triangle, or two edges. The gap is the length of
// sum(weight[k] * position[vertex[k]]); the weights sum to zero.
struct NearPair {
  std::array<int, 4> vertex;
  std::array<double, 4> weight;
  Vector3d normal;  // unit, from the second feature (negative weights) to the first
  double gap_m;
};

// Where features of a mesh lie: all that meshes of cloth have in common with what they may not touch.
struct Features {
  std::vector<Eigen::Vector2i> edges;
  std::vector<Vector3i> triangles;
};
Features features_of(const std::vector<Vector3i>& triangles);

struct NearResult {
  std::vector<NearPair> pairs;  // in a fixed order
  // Per vertex: the smallest gap to a feature that does not share a vertex with the one it belongs to, at most the
  // reach. As long as no vertex moves by half of its room, nothing meets that did not meet before (Wu et al., "A safe
  // and fast repulsion method for GPU-based cloth self collisions", 2020).
  std::vector<double> room_m;
};

// All pairs of features nearer than `reach_m` of which one at least moves. Vertices from `first_fixed` on do not move;
// their features come behind all others.
// Both features of a pair share no vertex.
NearResult near_pairs(const std::vector<Vector3d>& positions, const Features& features, int first_fixed,
                      double reach_m);

}  // namespace dressform
