#include "pipeline/texture/alpha_expansion.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

namespace dressform {
namespace {

constexpr int kMaxRounds = 10;       // three are usual
constexpr double kLeastGain = 1e-9;  // of the energy: less is rounding

double energy(const Eigen::MatrixXd& costs, const std::vector<PottsEdge>& edges, const std::vector<int>& labels) {
  double sum = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) sum += costs(static_cast<Eigen::Index>(i), labels[i]);
  for (const PottsEdge& edge : edges) sum += labels[edge.a] != labels[edge.b] ? edge.weight : 0;
  return sum;
}

// The best labelling in which every node either keeps its label or takes `alpha`.
std::vector<int> expanded(const Eigen::MatrixXd& costs, const std::vector<PottsEdge>& edges, std::vector<int> labels,
                          int alpha) {
  const int count = static_cast<int>(labels.size());
  std::vector<double> take(count);  // cost of taking alpha less cost of keeping
  for (int i = 0; i < count; ++i) take[i] = costs(i, alpha) - costs(i, labels[i]);
  cv::detail::GCGraph<double> graph(static_cast<unsigned>(count), static_cast<unsigned>(2 * edges.size() + 2));
  for (int i = 0; i < count; ++i) graph.addVtx();
  bool joined = false;
  for (const PottsEdge& edge : edges) {
    const int a = labels[edge.a], b = labels[edge.b];
    const double keep_both = a != b ? edge.weight : 0;
    const double take_b = a != alpha ? edge.weight : 0, take_a = b != alpha ? edge.weight : 0;
    take[edge.a] += take_a - keep_both;
    take[edge.b] -= take_a;
    if (const double capacity = take_b + take_a - keep_both; capacity > 0) {
      graph.addEdges(edge.a, edge.b, capacity, 0);
      joined = true;
    }
  }
  for (int i = 0; i < count; ++i) graph.addTermWeights(i, std::max(0.0, take[i]), std::max(0.0, -take[i]));
  if (joined) graph.maxFlow();
  for (int i = 0; i < count; ++i)
    if (joined ? !graph.inSourceSegment(i) : take[i] < 0) labels[i] = alpha;
  return labels;
}

}  // namespace

std::vector<int> alpha_expansion(const Eigen::MatrixXd& costs, const std::vector<PottsEdge>& edges) {
  std::vector<int> labels(costs.rows());
  for (Eigen::Index i = 0; i < costs.rows(); ++i) {
    Eigen::Index best = 0;
    costs.row(i).minCoeff(&best);
    labels[i] = static_cast<int>(best);
  }
  if (edges.empty()) return labels;
  double least = energy(costs, edges, labels);
  bool better = costs.cols() > 1;
  for (int round = 0; round < kMaxRounds && better; ++round) {
    better = false;
    for (int alpha = 0; alpha < costs.cols(); ++alpha) {
      std::vector<int> proposed = expanded(costs, edges, labels, alpha);
      const double reached = energy(costs, edges, proposed);
      if (!(reached < least * (1 - kLeastGain))) continue;
      least = reached;
      labels = std::move(proposed);
      better = true;
    }
  }
  return labels;
}

}  // namespace dressform
