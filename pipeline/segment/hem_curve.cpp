#include "pipeline/segment/hem_curve.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "pipeline/imaging/distance_transform.h"
#include "scenes/small_solvers.h"
#include "scenes/statistics.h"

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

cv::Mat near_plane(const cv::Mat& nats, const std::vector<int>& curve, int band_rows, float sure) {
  const auto row = [&](int c) {
    const double angle = 2 * M_PI * c / static_cast<double>(curve.size());
    return Eigen::Vector3d(1, std::cos(angle), std::sin(angle));
  };
  Eigen::Vector3d plane(median(curve), 0, 0);
  for (int round = 0; round < 20; ++round) {
    Eigen::Matrix3d normal = 1e-6 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t c = 0; c < curve.size(); ++c) {
      const Eigen::Vector3d a = row(static_cast<int>(c));
      const double weight = 1 / std::max(1.0, std::abs(a.dot(plane) - curve[c]));
      normal += weight * a * a.transpose();
      right += weight * curve[c] * a;
    }
    plane = solve_symmetric(normal, right);
  }
  cv::Mat result = nats.clone();
  for (int r = 0; r < nats.rows; ++r) {
    for (int c = 0; c < nats.cols; ++c) {
      const double off = r + 0.5 - row(c).dot(plane);
      if (std::abs(off) > band_rows) result.at<float>(r, c) += off > 0 ? 2 * sure : -2 * sure;
    }
  }
  return result;
}

}  // namespace dressform
