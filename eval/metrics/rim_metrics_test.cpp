#include "eval/metrics/rim_metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace dressform::metrics {
namespace {

ClosedLine circle(double radius, double height, int count) {
  ClosedLine line;
  for (int i = 0; i < count; ++i)
    line.push_back({radius * std::cos(2 * M_PI * i / count), height, radius * std::sin(2 * M_PI * i / count)});
  return line;
}

TEST(RimMetrics, ConcentricAndShiftedCircles) {
  EXPECT_NEAR(closed_length(circle(0.1, 0, 400)), 0.2 * M_PI, 1e-4);
  const auto same = compare_lines(circle(0.1, 0, 100), circle(0.1, 0, 100));
  EXPECT_LT(same.hd95_mm, 1e-9);
  const auto lifted = compare_lines(circle(0.1, 0.02, 400), circle(0.1, 0, 400));
  EXPECT_NEAR(lifted.chamfer_mm, 20, 0.01);
  EXPECT_NEAR(lifted.hd95_mm, 20, 0.01);
  EXPECT_NEAR(compare_lines(circle(0.11, 0, 400), circle(0.1, 0, 400)).chamfer_mm, 10, 0.05);
}

TEST(RimMetrics, MatchesByLeastTotalDistance) {
  const std::vector<ClosedLine> truth{circle(0.1, 0, 50), circle(0.1, 1, 50), circle(0.1, 2, 50)};
  const std::vector<ClosedLine> estimate{circle(0.1, 2.1, 50), circle(0.1, 0.1, 50)};
  EXPECT_EQ(match_lines(estimate, truth), (std::vector<int>{1, -1, 0}));
  EXPECT_EQ(match_lines({}, truth), (std::vector<int>{-1, -1, -1}));
  EXPECT_EQ(match_lines(truth, {truth[2]}), (std::vector<int>{2}));
}

TEST(RimMetrics, AssignmentIsOptimal) {
  Eigen::MatrixXd cost(4, 5);
  cost << 7, 5, 9, 8, 11, 9, 12, 7, 11, 10, 8, 5, 4, 6, 9, 7, 3, 6, 9, 6;
  const auto found = assign(cost);
  double total = 0;
  for (int i = 0; i < 4; ++i) total += cost(i, found[i]);
  double best = 1e9;
  std::vector<int> order{0, 1, 2, 3, 4};
  do {
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += cost(i, order[i]);
    best = std::min(best, sum);
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(total, best);
  const auto turned = assign(cost.transpose());
  EXPECT_EQ(std::count(turned.begin(), turned.end(), -1), 1);
}

}  // namespace
}  // namespace dressform::metrics
