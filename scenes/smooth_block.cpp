#include "scenes/smooth_block.h"

#include <limits>
#include <opencv2/imgproc.hpp>

namespace dressform {

cv::Rect smoothest_block(const cv::Mat& bgr, const cv::Mat& mask, int size_px) {
  const cv::Rect around = cv::boundingRect(mask);
  if (around.width < size_px || around.height < size_px) return {};
  cv::Mat grey, sum, squares, count;
  cv::cvtColor(bgr(around), grey, cv::COLOR_BGR2GRAY);
  cv::integral(grey, sum, squares, CV_64F, CV_64F);
  cv::integral(mask(around) / 255, count, CV_32S);
  const auto total = [size_px](const auto& table, int x, int y) {
    return table(y + size_px, x + size_px) - table(y, x + size_px) - table(y + size_px, x) + table(y, x);
  };
  const cv::Mat_<double> sums = sum, square_sums = squares;
  const cv::Mat_<int> counts = count;
  const int pixels = size_px * size_px;
  cv::Rect best;
  double least = std::numeric_limits<double>::infinity();
  for (int y = 0; y + size_px <= grey.rows; ++y)
    for (int x = 0; x + size_px <= grey.cols; ++x) {
      if (total(counts, x, y) < pixels) continue;
      const double mean = total(sums, x, y) / pixels, variance = total(square_sums, x, y) / pixels - mean * mean;
      if (variance >= least) continue;
      least = variance;
      best = cv::Rect(around.x + x, around.y + y, size_px, size_px);
    }
  return best;
}

}  // namespace dressform
