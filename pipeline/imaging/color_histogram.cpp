#include "pipeline/imaging/color_histogram.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace dressform {
namespace {

constexpr int kBins = 32, kShift = 3;
// Of the smoothing: window, and sigmas of what a pixel's noise moves it in Lab and of the lens's blur.
constexpr int kSmoothed_px = 5;
constexpr double kSmoothed_levels = 18, kSmoothedReach_px = 1.5;

std::size_t cell(int a, int b, int c) { return (static_cast<std::size_t>(a) * kBins + b) * kBins + c; }

// One pass of [1 2 1] / 4 along the axis whose cells are `stride` apart.
void smooth_along(std::vector<float>& cells, std::size_t stride) {
  const std::vector<float> old = cells;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const std::size_t position = (k / stride) % kBins;
    const float before = position > 0 ? old[k - stride] : old[k];
    const float after = position + 1 < kBins ? old[k + stride] : old[k];
    cells[k] = 0.25f * before + 0.5f * old[k] + 0.25f * after;
  }
}

}  // namespace

cv::Mat smoothed_lab(const cv::Mat& bgr) {
  cv::Mat lab, smooth;
  cv::cvtColor(bgr, lab, cv::COLOR_BGR2Lab);
  cv::bilateralFilter(lab, smooth, kSmoothed_px, kSmoothed_levels, kSmoothedReach_px);
  return smooth;
}

ColorHistogram::ColorHistogram() : cells_(kBins * kBins * kBins, 0.f) {}

void ColorHistogram::add(const cv::Vec3b& color, float weight) {
  cells_[cell(color[0] >> kShift, color[1] >> kShift, color[2] >> kShift)] += weight;
  weight_ += weight;
}

void ColorHistogram::add(const cv::Mat& colors, const cv::Mat& mask) {
  for (int y = 0; y < colors.rows; ++y)
    for (int x = 0; x < colors.cols; ++x)
      if (mask.at<uchar>(y, x)) add(colors.at<cv::Vec3b>(y, x));
}

void ColorHistogram::finish() {
  for (const std::size_t stride : {std::size_t{1}, std::size_t{kBins}, std::size_t{kBins} * kBins})
    smooth_along(cells_, stride);
}

float ColorHistogram::log_density(const cv::Vec3b& color, float outlier) const {
  if (weight_ <= 0) return 0;
  const float share = cells_[cell(color[0] >> kShift, color[1] >> kShift, color[2] >> kShift)] /
                      static_cast<float>(weight_) * static_cast<float>(cells_.size());
  return std::log((1 - outlier) * share + outlier);
}

}  // namespace dressform
