#include "pipeline/extract/depth_components.h"

#include <cmath>
#include <opencv2/core.hpp>

namespace dressform {

DepthComponents depth_components(const cv::Mat& depth_mm, const cv::Mat& allowed, double max_jump_mm) {
  DepthComponents result{cv::Mat(depth_mm.size(), CV_32S, cv::Scalar(-1)), {}};
  const cv::Point steps[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  const cv::Rect grid({0, 0}, depth_mm.size());
  std::vector<cv::Point> open;
  for (int y = 0; y < depth_mm.rows; ++y) {
    for (int x = 0; x < depth_mm.cols; ++x) {
      const auto usable = [&](const cv::Point& p) {
        return depth_mm.at<float>(p) > 0 && allowed.at<uchar>(p) && result.labels.at<int>(p) < 0;
      };
      if (!usable({x, y})) continue;
      const int index = static_cast<int>(result.sizes.size());
      result.sizes.push_back(0);
      open.assign(1, {x, y});
      result.labels.at<int>(y, x) = index;
      while (!open.empty()) {
        const cv::Point at = open.back();
        open.pop_back();
        ++result.sizes.back();
        for (const cv::Point& step : steps) {
          const cv::Point next = at + step;
          if (!grid.contains(next) || !usable(next)) continue;
          if (std::abs(depth_mm.at<float>(next) - depth_mm.at<float>(at)) > max_jump_mm) continue;
          result.labels.at<int>(next) = index;
          open.push_back(next);
        }
      }
    }
  }
  return result;
}

}  // namespace dressform
