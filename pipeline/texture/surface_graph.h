#pragma once
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// Who touches whom on a triangle mesh.
struct SurfaceGraph {
  struct Edge {
    int a, b;                   // vertices, a < b
    int left = -1, right = -1;  // triangles; right = -1 on a boundary. Edges of more than two triangles come in pairs.
    double length_m;
  };
  explicit SurfaceGraph(const Mesh& mesh);

  std::vector<Edge> edges;                  // sorted by (a, b)
  std::vector<std::vector<int>> neighbors;  // of every vertex, ascending
  std::vector<double> triangle_area_m2;
  double mean_edge_m = 0;
};

// Values on vertices (one row a vertex) spread over the surface as heat does: each step a vertex moves half way to the
// mean of its neighbours. `reach_m` is the standard deviation of the spread.
Eigen::MatrixXf spread_over_surface(const SurfaceGraph& graph, Eigen::MatrixXf values, double reach_m);

// Values where `known`, and in between the smooth surface through them (every other vertex the mean of its neighbours,
// to within 1e-3 of the range of 255). Pieces of surface without a known vertex take the mean of all known ones.
Eigen::MatrixXf fill_over_surface(const SurfaceGraph& graph, Eigen::MatrixXf values, const std::vector<bool>& known);

}  // namespace dressform
