#include "pipeline/segment/hem_curve.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "pipeline/common/distance_transform.h"

namespace dressform {
namespace {

// cost[h]: what a column pays when rows >= h are top.
std::vector<double> column_costs(const cv::Mat& nats, int column) {
  std::vector<double> cost(static_cast<std::size_t>(nats.rows) + 1, 0);
  double above = 0;
  for (int row = 0; row < nats.rows; ++row) above += nats.at<float>(row, column);
  double below = 0;
  for (int h = 0; h <= nats.rows; ++h) {
    cost[h] = below - above;
    if (h == nats.rows) break;
    below += nats.at<float>(h, column);
    above -= nats.at<float>(h, column);
  }
  return cost;
}

}  // namespace

std::vector<int> trace_hem(const cv::Mat& nats, double row_price) {
  const int columns = nats.cols, rounds = 3;
  std::vector<double> best(static_cast<std::size_t>(nats.rows) + 1, 0);
  std::vector<std::vector<int>> from;
  for (int k = 0; k < rounds * columns; ++k) {
    from.emplace_back(best.size());
    spread_costs(best.data(), from.back().data(), static_cast<int>(best.size()), row_price);
    const auto own = column_costs(nats, k % columns);
    for (std::size_t h = 0; h < best.size(); ++h) best[h] += own[h];
  }
  int at = static_cast<int>(std::min_element(best.begin(), best.end()) - best.begin());
  std::vector<int> hem(static_cast<std::size_t>(columns), 0);
  for (int k = rounds * columns - 1; k >= columns; --k) {
    if (k < 2 * columns) hem[k - columns] = at;  // the middle round feels neighbours on both sides
    at = from[k][at];
  }
  return hem;
}

}  // namespace dressform
