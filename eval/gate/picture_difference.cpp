#include "eval/gate/picture_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "eval/metrics/flip.h"

namespace dressform {
namespace {

constexpr int kTile = 16, kTileStep = kTile / 2;
constexpr double kLargestLevel = 255;

// Where tiles begin along a side of `size` pixels; the last one ends with the side.
std::vector<int> tile_starts(int size) {
  std::vector<int> starts;
  for (int at = 0; at + kTile <= size; at += kTileStep) starts.push_back(at);
  const int last = std::max(0, size - kTile);
  if (starts.empty() || starts.back() != last) starts.push_back(last);
  return starts;
}

struct WorstTile {
  double mean = 0;
  int x = 0, y = 0;
};

// Of a CV_64FC1 image; the first of equal ones.
WorstTile worst_tile(const cv::Mat& values) {
  cv::Mat sums;
  cv::integral(values, sums, CV_64F);
  WorstTile worst;
  for (const int y : tile_starts(values.rows))
    for (const int x : tile_starts(values.cols)) {
      const int right = std::min(values.cols, x + kTile), below = std::min(values.rows, y + kTile);
      const double sum =
          sums.at<double>(below, right) - sums.at<double>(y, right) - sums.at<double>(below, x) + sums.at<double>(y, x);
      const double mean = sum / ((right - x) * (below - y));
      if (mean > worst.mean) worst = {mean, x, y};
    }
  return worst;
}

cv::Mat mean_of_channels(const cv::Mat& bgr) {
  cv::Mat values, mean;
  bgr.convertTo(values, CV_64FC3);
  cv::transform(values, mean, cv::Matx13d(1.0 / 3, 1.0 / 3, 1.0 / 3));
  return mean;
}

// All but FLIP, which is 0.
PictureDifference level_difference(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != CV_8UC3 || b.type() != CV_8UC3)
    return {kLargestLevel, kLargestLevel, 1, 1, 0, 0, false};
  cv::Mat difference;
  cv::absdiff(a, b, difference);
  if (cv::countNonZero(difference.reshape(1)) == 0) return {};
  const cv::Mat levels = mean_of_channels(difference);
  const WorstTile worst = worst_tile(levels);
  return {cv::mean(levels)[0], worst.mean, 0, 0, worst.x, worst.y, true};
}

}  // namespace

PictureDifference picture_difference(const cv::Mat& a, const cv::Mat& b) {
  PictureDifference result = level_difference(a, b);
  if (!result.comparable || result.mean_levels == 0) return result;
  cv::Mat flip;
  metrics::flip_map(a, b).convertTo(flip, CV_64F);
  result.flip = cv::mean(flip)[0];
  result.worst_tile_flip = worst_tile(flip).mean;
  return result;
}

bool told_apart(const cv::Mat& a, const cv::Mat& b, const PictureTolerance& tolerance) {
  return tolerance.excess(level_difference(a, b)) > 1 || tolerance.excess(picture_difference(a, b)) > 1;
}

double PictureTolerance::excess(const PictureDifference& difference) const {
  if (!difference.comparable) return std::numeric_limits<double>::infinity();
  const auto times = [](double value, double tolerance) {
    if (value == 0) return 0.0;
    return tolerance > 0 ? value / tolerance : std::numeric_limits<double>::infinity();
  };
  return std::max({times(difference.mean_levels, mean_levels), times(difference.worst_tile_levels, worst_tile_levels),
                   times(difference.flip, flip), times(difference.worst_tile_flip, worst_tile_flip)});
}

std::string picture_text(const PictureDifference& difference) {
  if (!difference.comparable) return "another size or kind of picture";
  return fmt::format("mean {:.2f} levels, worst tile {:.2f} at ({}, {}), FLIP {:.4f}, worst tile {:.4f}",
                     difference.mean_levels, difference.worst_tile_levels, difference.tile_x, difference.tile_y,
                     difference.flip, difference.worst_tile_flip);
}

}  // namespace dressform
