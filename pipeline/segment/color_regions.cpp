#include "pipeline/segment/color_regions.h"

#include <opencv2/core.hpp>
#include <vector>

namespace dressform {
namespace {

// What has a key and no label takes that of the labelled pixel that is fewest steps away within the keys, the first in
// reading order among equals.
void spread_labels(const cv::Mat& keys, cv::Mat& labels) {
  const cv::Point steps[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  const cv::Rect image({0, 0}, keys.size());
  std::vector<cv::Point> front, next;
  for (int y = 0; y < keys.rows; ++y)
    for (int x = 0; x < keys.cols; ++x)
      if (labels.at<int>(y, x)) front.emplace_back(x, y);
  for (; !front.empty(); front.swap(next)) {
    next.clear();
    for (const cv::Point& at : front)
      for (const cv::Point& step : steps) {
        const cv::Point to = at + step;
        if (!image.contains(to) || !keys.at<int>(to) || labels.at<int>(to)) continue;
        labels.at<int>(to) = labels.at<int>(at);
        next.push_back(to);
      }
  }
}

}  // namespace

LabelMap pieces_of_keys(const cv::Mat& keys, int least_px) {
  LabelMap large = connected_pieces(keys, least_px);
  spread_labels(keys, large.labels);
  cv::Mat left = keys.clone();
  left.setTo(0, large.labels != 0);
  const LabelMap small = connected_pieces(left);
  cv::Mat(small.labels + large.count).copyTo(large.labels, small.labels != 0);
  large.count += small.count;
  return large;
}

}  // namespace dressform
