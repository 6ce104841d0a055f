#include "pipeline/segment/hem_edges.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "pipeline/segment/cloth_zones.h"

namespace dressform {
namespace {

constexpr int kStepGap_rows = 2, kStepReach_rows = 9;  // beside the curve, where offsets are compared
constexpr int kLineReach_rows = 3;                     // where colours are
constexpr float kStepNoise_mm = 1.5f, kStepMost_mm = 6, kLineNoise = 2, kLineMost = 8;
constexpr float kOutside = 50;  // nats against a curve beyond the two heights

// Running sums up the columns of the grid: [offset mm, offsets, L, a, b, colours].
using Sums = cv::Vec<double, 6>;

cv::Mat running_sums(const std::vector<ViewEvidence>& views, const std::vector<cv::Mat>& told, const TrunkGrid& grid) {
  cv::Mat sums = cv::Mat::zeros(grid.rows + 1, TrunkGrid::kColumns, CV_64FC(6));
  for (std::size_t k = 0; k < views.size(); ++k) {
    if (views[k].box.empty()) continue;
    each_cloth_pixel(views[k], told[k], [&](int v, int u) {
      const auto& place = views[k].place_m.at<cv::Vec3f>(v, u);
      Sums& cell = sums.at<Sums>(grid.row(place) + 1, grid.column(place));
      if (const float offset = views[k].offset_mm.at<float>(v, u); !std::isnan(offset)) {
        cell[0] += offset;
        cell[1] += 1;
      }
      for (int i = 0; i < 3; ++i) cell[2 + i] += views[k].lab.at<cv::Vec3b>(v, u)[i];
      cell[5] += 1;
    });
  }
  for (int r = 1; r <= grid.rows; ++r)
    for (int c = 0; c < TrunkGrid::kColumns; ++c) sums.at<Sums>(r, c) += sums.at<Sums>(r - 1, c);
  return sums;
}

Sums rows_between(const cv::Mat& sums, int first, int last, int column) {
  const int top = sums.rows - 1;
  return sums.at<Sums>(std::clamp(last, 0, top), column) - sums.at<Sums>(std::clamp(first, 0, top), column);
}

// How much a curve through the lower end of `row` looks like the end of the upper cloth.
float edge_at(const cv::Mat& sums, int row, int column) {
  float edge = 0;
  const Sums above = rows_between(sums, row + kStepGap_rows, row + kStepReach_rows, column),
             below = rows_between(sums, row - kStepReach_rows, row - kStepGap_rows, column);
  if (above[1] > 0 && below[1] > 0) {
    const auto step_mm = static_cast<float>(above[0] / above[1] - below[0] / below[1]);
    edge += std::clamp(step_mm - kStepNoise_mm, 0.f, kStepMost_mm);
  }
  const Sums over = rows_between(sums, row, row + kLineReach_rows, column),
             under = rows_between(sums, row - kLineReach_rows, row, column);
  if (over[5] > 0 && under[5] > 0) {
    double square = 0;
    for (int i = 2; i < 5; ++i) square += std::pow(over[i] / over[5] - under[i] / under[5], 2);
    edge += std::clamp(static_cast<float>(std::sqrt(square)) - kLineNoise, 0.f, kLineMost);
  }
  return edge;
}

}  // namespace

cv::Mat edge_nats(const std::vector<ViewEvidence>& views, const std::vector<cv::Mat>& told, const TrunkGrid& grid,
                  double lowest_y, double highest_y) {
  const cv::Mat sums = running_sums(views, told, grid);
  const auto price = [&](int row, int column) {
    const double y = grid.floor_y + row * TrunkGrid::kRow_m;
    return y < lowest_y || y > highest_y ? kOutside : -edge_at(sums, row, column);
  };
  // A curve below row r + 1 instead of r pays twice the nats of row r.
  cv::Mat nats(grid.rows, TrunkGrid::kColumns, CV_32F);
  for (int c = 0; c < nats.cols; ++c)
    for (int r = 0; r < nats.rows; ++r) nats.at<float>(r, c) = (price(r + 1, c) - price(r, c)) / 2;
  return nats;
}

}  // namespace dressform
