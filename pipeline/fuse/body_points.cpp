#include "pipeline/fuse/body_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "scenes/disjoint_sets.h"

namespace dressform {
namespace {

using Cell = std::array<int, 3>;

Cell cell_of(const Vector3d& p, double edge_m) {
  return {static_cast<int>(std::floor(p.x() / edge_m)), static_cast<int>(std::floor(p.y() / edge_m)),
          static_cast<int>(std::floor(p.z() / edge_m))};
}

// Component of every cell (sorted, unique): cells that touch, corners included, are one. A label is the index of the
// component's first cell.
std::vector<int> cell_components(const std::vector<Cell>& cells) {
  DisjointSets sets(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (int k = 0; k < 13; ++k) {  // half of the 26 neighbours
      const Cell near{cells[i][0] + k / 9 - 1, cells[i][1] + k / 3 % 3 - 1, cells[i][2] + k % 3 - 1};
      const auto found = std::lower_bound(cells.begin(), cells.end(), near);
      if (found == cells.end() || *found != near) continue;
      sets.join(static_cast<int>(i), static_cast<int>(found - cells.begin()));
    }
  std::vector<int> labels(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) labels[i] = sets.root(static_cast<int>(i));
  return labels;
}

PointCloud subset(const PointCloud& cloud, const std::vector<int>& kept) {
  PointCloud result;
  for (const int i : kept) {
    result.points.push_back(cloud.points[i]);
    result.normals.push_back(cloud.normals[i]);
  }
  return result;
}

}  // namespace

PointCloud body_points(const PointCloud& cloud, double axis_x, double axis_z, const BodyPointsOptions& options) {
  constexpr double kNearAxis = 0.4;  // metres: the body is the thing with most points so near
  std::vector<int> above;
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    if (cloud.points[i].y() > options.floor_cut_m) above.push_back(static_cast<int>(i));
  std::vector<Cell> cells;
  for (const int i : above) cells.push_back(cell_of(cloud.points[i], options.gap_m));
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  const auto label_of_cell = cell_components(cells);
  std::vector<int> label(above.size()), votes(cells.size(), 0);
  for (std::size_t k = 0; k < above.size(); ++k) {
    const Vector3d& p = cloud.points[above[k]];
    label[k] = label_of_cell[std::lower_bound(cells.begin(), cells.end(), cell_of(p, options.gap_m)) - cells.begin()];
    if (std::hypot(p.x() - axis_x, p.z() - axis_z) < kNearAxis) ++votes[label[k]];
  }
  if (votes.empty()) return {};
  const int body = static_cast<int>(std::max_element(votes.begin(), votes.end()) - votes.begin());
  std::vector<int> kept;
  for (std::size_t k = 0; k < above.size(); ++k)
    if (label[k] == body) kept.push_back(above[k]);
  return subset(cloud, kept);
}

PointCloud sole_points(const PointCloud& body, double spacing_m) {
  constexpr double kHighest = 0.035;  // metres above the floor: a foot is widest there, and its sole right below
  constexpr double kMargin = 0.05;    // of the plan about the feet
  constexpr double kGap = 0.012;      // between points of one sole: less than between two feet
  std::vector<cv::Point2d> low;
  for (const auto& p : body.points)
    if (p.y() < kHighest) low.emplace_back(p.x(), p.z());
  PointCloud soles;
  if (low.empty()) return soles;
  cv::Point2d first = low[0], last = low[0];
  for (const auto& p : low) {
    first = {std::min(first.x, p.x), std::min(first.y, p.y)};
    last = {std::max(last.x, p.x), std::max(last.y, p.y)};
  }
  first -= cv::Point2d(kMargin, kMargin);
  const auto cells = [&](double length) { return static_cast<int>((length + kMargin) / spacing_m) + 1; };
  cv::Mat plan(cells(last.y - first.y), cells(last.x - first.x), CV_8U, cv::Scalar(0));
  for (const auto& p : low)
    plan.at<std::uint8_t>(static_cast<int>((p.y - first.y) / spacing_m),
                          static_cast<int>((p.x - first.x) / spacing_m)) = 255;
  const int reach = std::max(1, static_cast<int>(std::lround(kGap / spacing_m)));
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1});
  cv::morphologyEx(plan, plan, cv::MORPH_CLOSE, disc);
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(plan.clone(), outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::drawContours(plan, outlines, -1, cv::Scalar(255), cv::FILLED);
  cv::erode(plan, plan, cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3}));
  for (int y = 0; y < plan.rows; ++y)
    for (int x = 0; x < plan.cols; ++x) {
      if (!plan.at<std::uint8_t>(y, x)) continue;
      soles.points.emplace_back(first.x + (x + 0.5) * spacing_m, 0, first.y + (y + 0.5) * spacing_m);
      soles.normals.emplace_back(0, -1, 0);
    }
  return soles;
}

}  // namespace dressform
