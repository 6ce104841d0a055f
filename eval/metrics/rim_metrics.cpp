#include "eval/metrics/rim_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "eval/metrics/sampling.h"

namespace dressform::metrics {
namespace {

constexpr double kStep = 0.001;

std::vector<Vector3d> points_along(const ClosedLine& line) {
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vector3d &from = line[i], to = line[(i + 1) % line.size()];
    const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / kStep)));
    for (int k = 0; k < steps; ++k) points.push_back(from + (to - from) * (double(k) / steps));
  }
  return points;
}

double distance_mm(const Vector3d& point, const ClosedLine& line) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vector3d &from = line[i], side = line[(i + 1) % line.size()] - from;
    const double length = side.squaredNorm();
    const double along = length > 0 ? std::clamp((point - from).dot(side) / length, 0.0, 1.0) : 0;
    best = std::min(best, (from + along * side - point).squaredNorm());
  }
  return std::sqrt(best) * 1000;
}

std::vector<double> distances_mm(const ClosedLine& from, const ClosedLine& to) {
  std::vector<double> result;
  for (const auto& point : points_along(from)) result.push_back(distance_mm(point, to));
  return result;
}

}  // namespace

double closed_length(const ClosedLine& line) {
  double length = 0;
  for (std::size_t i = 0; i < line.size(); ++i) length += (line[(i + 1) % line.size()] - line[i]).norm();
  return length;
}

LineDistance compare_lines(const ClosedLine& estimate, const ClosedLine& truth) {
  const auto there = distances_mm(estimate, truth), back = distances_mm(truth, estimate);
  return {(mean(there) + mean(back)) / 2, std::max(quantile(there, 0.95), quantile(back, 0.95))};
}

std::vector<int> match_lines(const std::vector<ClosedLine>& estimate, const std::vector<ClosedLine>& truth) {
  Eigen::MatrixXd cost(truth.size(), estimate.size());
  for (std::size_t row = 0; row < truth.size(); ++row)
    for (std::size_t column = 0; column < estimate.size(); ++column)
      cost(row, column) = compare_lines(estimate[column], truth[row]).chamfer_mm;
  return assign(cost);
}

std::vector<int> assign(const Eigen::MatrixXd& cost) {
  const auto rows = static_cast<int>(cost.rows()), columns = static_cast<int>(cost.cols());
  std::vector<int> result(rows, -1);
  if (rows == 0 || columns == 0) return result;
  if (rows > columns) {
    const auto transposed = assign(cost.transpose());
    for (int column = 0; column < columns; ++column) result[transposed[column]] = column;
    return result;
  }
  // Shortest augmenting paths with potentials; index 0 stands for "none".
  std::vector<double> row_potential(rows + 1, 0), column_potential(columns + 1, 0);
  std::vector<int> row_of(columns + 1, 0), previous(columns + 1, 0);
  for (int row = 1; row <= rows; ++row) {
    row_of[0] = row;
    int column = 0;
    std::vector<double> slack(columns + 1, std::numeric_limits<double>::infinity());
    std::vector<bool> used(columns + 1, false);
    do {
      used[column] = true;
      int next = 0;
      double step = std::numeric_limits<double>::infinity();
      for (int j = 1; j <= columns; ++j) {
        if (used[j]) continue;
        const double reduced = cost(row_of[column] - 1, j - 1) - row_potential[row_of[column]] - column_potential[j];
        if (reduced < slack[j]) {
          slack[j] = reduced;
          previous[j] = column;
        }
        if (slack[j] < step) {
          step = slack[j];
          next = j;
        }
      }
      for (int j = 0; j <= columns; ++j) {
        if (used[j]) {
          row_potential[row_of[j]] += step;
          column_potential[j] -= step;
        } else {
          slack[j] -= step;
        }
      }
      column = next;
    } while (row_of[column] != 0);
    for (; column != 0; column = previous[column]) row_of[column] = row_of[previous[column]];
  }
  for (int j = 1; j <= columns; ++j)
    if (row_of[j] != 0) result[row_of[j] - 1] = j - 1;
  return result;
}

}  // namespace dressform::metrics
