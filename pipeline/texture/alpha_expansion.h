#pragma once
#include <Eigen/Core>
#include <vector>

namespace dressform {

struct PottsEdge {
  int a, b;
  double weight;  // paid when the labels of a and b differ; not negative
};

// Labels that locally minimise the sum of costs(node, label) and of the weights of edges whose ends differ: alpha
// expansion by minimum cuts (Boykov, Veksler and Zabih, PAMI 2001; the cut's construction: Kolmogorov and Zabih, PAMI
// 2004), from the cheapest label of every node. Deterministic. costs: nodes x labels, at least one label.
std::vector<int> alpha_expansion(const Eigen::MatrixXd& costs, const std::vector<PottsEdge>& edges);

}  // namespace dressform
