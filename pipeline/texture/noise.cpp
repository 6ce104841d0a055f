#include "pipeline/texture/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr int kBlock = 12;                        // pixels along a side
constexpr int kBins = 8;                          // of brightness
constexpr std::size_t kLeastBlocks = 25;          // a bin with fewer says nothing
constexpr double kSmoothest = 0.15;               // part of a bin's blocks that is taken for smooth
constexpr double kDarkest = 4, kBrightest = 250;  // clipped levels hide the noise

// Noise of every block and channel, by brightness.
std::array<std::vector<double>, kBins> noise_of_blocks(const cv::Mat& color) {
  // Every third pixel: behind a Bayer filter neighbours share their noise.
  constexpr int kStep = 3;
  cv::Mat kernel(2 * kStep + 1, 2 * kStep + 1, CV_32F, cv::Scalar(0));
  const float weight[3][3] = {{1, -2, 1}, {-2, 4, -2}, {1, -2, 1}};
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) kernel.at<float>(kStep * y, kStep * x) = weight[y][x];
  cv::Mat response;
  cv::filter2D(color, response, CV_32F, kernel);
  response = cv::abs(response);
  std::array<std::vector<double>, kBins> bins;
  for (int y = 1; y + kBlock < color.rows; y += kBlock)
    for (int x = 1; x + kBlock < color.cols; x += kBlock) {
      const cv::Rect block(x, y, kBlock, kBlock);
      const cv::Scalar level = cv::mean(color(block)), size = cv::mean(response(block));
      for (int c = 0; c < 3; ++c)
        if (level[c] > kDarkest && level[c] < kBrightest)
          bins[static_cast<int>(level[c] * kBins / 256)].push_back(size[c] * std::sqrt(M_PI / 2) / 6);
    }
  return bins;
}

}  // namespace

double noise_levels(const cv::Mat& color, double level) {
  if (color.cols <= 2 * kBlock || color.rows <= 2 * kBlock) return 0;
  const auto bins = noise_of_blocks(color);
  double weighted = 0, weights = 0;
  for (int i = 0; i < kBins; ++i) {
    if (bins[i].size() < kLeastBlocks) continue;
    const double noise = nth_value(bins[i], static_cast<std::size_t>(kSmoothest * static_cast<double>(bins[i].size())));
    // The nearest bins count most: an empty bin takes its neighbours' noise.
    const double away = (level - (i + 0.5) * 256 / kBins) / 16;
    const double weight = std::exp(-0.5 * away * away) + 1e-12 / (1 + away * away);
    weighted += weight * noise;
    weights += weight;
  }
  return weights > 0 ? weighted / weights : 0;
}

}  // namespace dressform
