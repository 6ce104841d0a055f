#include "pipeline/texture/surface_graph.h"

#include <algorithm>
#include <cmath>

#include "scenes/mesh_sides.h"
#include "scenes/triangle.h"

namespace dressform {
namespace {

constexpr double kMostSteps = 2000;  // of spreading: a reach beyond that is the whole garment
constexpr int kMostSweeps = 300;
constexpr float kSettled = 0.255f;  // a thousandth of the levels: changes smaller than this are not seen

Eigen::RowVectorXf neighbor_mean(const SurfaceGraph& graph, const Eigen::MatrixXf& values, int vertex) {
  Eigen::RowVectorXf sum = Eigen::RowVectorXf::Zero(values.cols());
  for (const int n : graph.neighbors[vertex]) sum += values.row(n);
  return sum / static_cast<float>(graph.neighbors[vertex].size());
}

// First guess for unknown vertices: layer by layer outwards from the known ones.
std::vector<int> spread_in_layers(const SurfaceGraph& graph, Eigen::MatrixXf& values, std::vector<bool> known) {
  std::vector<int> order, layer;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i]) layer.push_back(static_cast<int>(i));
  while (!layer.empty()) {
    std::vector<int> next;
    for (const int v : layer)
      for (const int n : graph.neighbors[v])
        if (!known[n]) next.push_back(n);
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    for (const int v : next) {
      Eigen::RowVectorXf sum = Eigen::RowVectorXf::Zero(values.cols());
      int count = 0;
      for (const int n : graph.neighbors[v])
        if (known[n]) {
          sum += values.row(n);
          ++count;
        }
      values.row(v) = sum / static_cast<float>(count);
    }
    for (const int v : next) known[v] = true;
    order.insert(order.end(), next.begin(), next.end());
    layer = std::move(next);
  }
  return order;
}

}  // namespace

SurfaceGraph::SurfaceGraph(const Mesh& mesh) : neighbors(mesh.vertices.size()) {
  for_edges(sorted_sides(mesh), [&](const TriangleSide* side, const TriangleSide* last) {
    const int a = side->low, b = side->high;
    while (side < last) {
      Edge edge{a, b, side->triangle, -1, (mesh.vertices[a] - mesh.vertices[b]).norm()};
      if (++side < last) edge.right = side++->triangle;
      edges.push_back(edge);
      mean_edge_m += edge.length_m;
      neighbors[a].push_back(b);
      neighbors[b].push_back(a);
    }
  });
  if (!edges.empty()) mean_edge_m /= static_cast<double>(edges.size());
  for (auto& list : neighbors) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  triangle_area_m2 = triangle_areas_m2(mesh);
}

Eigen::MatrixXf spread_over_surface(const SurfaceGraph& graph, Eigen::MatrixXf values, double reach_m) {
  if (!(graph.mean_edge_m > 0)) return values;
  // A half step to the mean of a ring of radius e has a variance of e^2 / 4 along each direction.
  const double per_step = 0.25 * graph.mean_edge_m * graph.mean_edge_m;
  const int steps = static_cast<int>(std::min(kMostSteps, std::ceil(reach_m * reach_m / per_step)));
  Eigen::MatrixXf next = values;
  for (int step = 0; step < steps; ++step) {
    for (int v = 0; v < values.rows(); ++v)
      if (!graph.neighbors[v].empty()) next.row(v) = 0.5f * (values.row(v) + neighbor_mean(graph, values, v));
    std::swap(values, next);
  }
  return values;
}

Eigen::MatrixXf fill_over_surface(const SurfaceGraph& graph, Eigen::MatrixXf values, const std::vector<bool>& known) {
  Eigen::RowVectorXf mean = Eigen::RowVectorXf::Zero(values.cols());
  int count = 0;
  for (int v = 0; v < values.rows(); ++v)
    if (known[v]) {
      mean += values.row(v);
      ++count;
    }
  if (count == 0) return values;
  mean /= static_cast<float>(count);
  for (int v = 0; v < values.rows(); ++v)
    if (!known[v]) values.row(v) = mean;
  const std::vector<int> order = spread_in_layers(graph, values, known);
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    float largest = 0;
    for (const int v : order) {
      const Eigen::RowVectorXf mean_around = neighbor_mean(graph, values, v);
      largest = std::max(largest, (mean_around - values.row(v)).cwiseAbs().maxCoeff());
      values.row(v) = mean_around;
    }
    if (largest < kSettled) break;
  }
  return values;
}

}  // namespace dressform
