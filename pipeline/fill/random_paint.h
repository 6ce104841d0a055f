#pragma once
#include "pipeline/fill/fill_views.h"
#include "scenes/random.h"

namespace dressform {

// Stream of the random numbers of one view's garment.
inline std::uint64_t paint_stream(const std::vector<GarmentView>& views, std::size_t index) {
  return stream_of("fill.random31") + 16 * index + static_cast<std::uint64_t>(views[index].label);
}

// The garment's image in which every filled pixel (mask == 128) has the colour of a random pixel of `lends` (uint8 at
// colour size, not 0: of the block). Unchanged where it lends none.
inline cv::Mat painted_at_random(const FilledGarment& garment, const cv::Mat& lends, std::uint64_t stream, Seed seed) {
  std::vector<cv::Vec3b> colors;
  for (int y = 0; y < lends.rows; ++y)
    for (int x = 0; x < lends.cols; ++x)
      if (lends.at<uchar>(y, x)) colors.push_back(garment.color.at<cv::Vec3b>(y, x));
  cv::Mat painted = garment.color.clone();
  if (colors.empty()) return painted;
  for (int y = 0; y < painted.rows; ++y)
    for (int x = 0; x < painted.cols; ++x) {
      if (garment.mask.at<uchar>(y, x) != 128) continue;
      const double random = uniform4(seed, stream, static_cast<std::uint64_t>(y) * painted.cols + x)[0];
      const auto drawn = static_cast<std::size_t>(random * static_cast<double>(colors.size()));
      painted.at<cv::Vec3b>(y, x) = colors[std::min(drawn, colors.size() - 1)];
    }
  return painted;
}

}  // namespace dressform
