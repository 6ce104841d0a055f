#include "pipeline/texture/alpha_expansion.h"

#include <gtest/gtest.h>

namespace dressform {
namespace {

TEST(AlphaExpansion, WithoutEdgesTakesTheCheapest) {
  Eigen::MatrixXd costs(3, 2);
  costs << 0, 1, 2, 1, 5, 0;
  EXPECT_EQ(alpha_expansion(costs, {}), (std::vector<int>{0, 1, 1}));
}

TEST(AlphaExpansion, OutlierFollowsItsNeighboursWhenTheSeamsAreDearer) {
  Eigen::MatrixXd costs(5, 3);
  costs << 0, 1, 9, 0, 1, 9, 1, 0.5, 9, 0, 1, 9, 0, 1, 9;
  std::vector<PottsEdge> edges;
  for (int i = 0; i + 1 < 5; ++i) edges.push_back({i, i + 1, 0.4});
  EXPECT_EQ(alpha_expansion(costs, edges), std::vector<int>(5, 0));
  for (PottsEdge& edge : edges) edge.weight = 0.1;
  EXPECT_EQ(alpha_expansion(costs, edges), (std::vector<int>{0, 0, 1, 0, 0}));
}

// A ring of four labels: compared with the best of all 4^6 labellings.
TEST(AlphaExpansion, FindsTheOptimumOfASmallRing) {
  Eigen::MatrixXd costs(6, 4);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 4; ++j) costs(i, j) = ((i * 7 + j * 5) % 11) / 11.0;
  std::vector<PottsEdge> edges;
  for (int i = 0; i < 6; ++i) edges.push_back({i, (i + 1) % 6, 0.15 + 0.05 * i});
  const auto energy = [&](const std::vector<int>& labels) {
    double sum = 0;
    for (int i = 0; i < 6; ++i) sum += costs(i, labels[i]);
    for (const PottsEdge& e : edges) sum += labels[e.a] != labels[e.b] ? e.weight : 0;
    return sum;
  };
  double best = 1e9;
  for (int code = 0; code < 4096; ++code) {
    std::vector<int> labels;
    for (int i = 0, rest = code; i < 6; ++i, rest /= 4) labels.push_back(rest % 4);
    best = std::min(best, energy(labels));
  }
  EXPECT_NEAR(energy(alpha_expansion(costs, edges)), best, 0.1);
}

}  // namespace
}  // namespace dressform
