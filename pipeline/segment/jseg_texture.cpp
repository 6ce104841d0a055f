#include "pipeline/segment/jseg_texture.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

namespace dressform {
namespace {

constexpr int kHalf = 4;            // of the window, in samples
constexpr int kRadiusSquared = 18;  // rows of 3, 7, 7, 9, 9, 9, 7, 7, 3 samples
constexpr double kNoScatter = 1e-6;

// Count, x and y of a class's samples in one word: 8, 12 and 12 bits. 61 samples at 0 to 8 fit.
std::uint32_t packed(int x, int y) {
  return 1u | static_cast<std::uint32_t>(x) << 8 | static_cast<std::uint32_t>(y) << 20;
}

struct Sample {
  int dx, dy;          // pixels
  std::uint32_t word;  // packed
  int squares;         // of its place in the window
  int offset;          // in the image, from the window's middle
};

std::vector<Sample> window(int step, int columns) {
  std::vector<Sample> samples;
  for (int y = -kHalf; y <= kHalf; ++y)
    for (int x = -kHalf; x <= kHalf; ++x)
      if (x * x + y * y <= kRadiusSquared)
        samples.push_back({x * step, y * step, packed(x + kHalf, y + kHalf),
                           (x + kHalf) * (x + kHalf) + (y + kHalf) * (y + kHalf), (y * columns + x) * step});
  return samples;
}

// J from what `sums` holds of the `count` classes in `seen`, which are set to 0 again.
float j_of_sums(std::vector<std::uint32_t>& sums, const std::vector<int>& seen, int count, int squares) {
  double of_classes = 0;
  std::uint32_t all = 0, n_all = 0;
  for (int i = 0; i < count; ++i) {
    const std::uint32_t word = sums[seen[i]];
    sums[seen[i]] = 0;
    const auto n = static_cast<double>(word & 255), x = static_cast<double>(word >> 8 & 4095),
               y = static_cast<double>(word >> 20);
    of_classes += (x * x + y * y) / n;
    n_all += word & 255;
    all += word >> 8;  // without the counts: 61 of them fit
  }
  const auto x = static_cast<double>(all & 4095), y = static_cast<double>(all >> 12);
  const double total = squares - (x * x + y * y) / n_all, within = squares - of_classes;
  if (total < kNoScatter) return 0;
  if (within < kNoScatter) return kMostJ;
  return std::min(kMostJ, static_cast<float>((total - within) / within));
}

// Mean of the pixels of the same region in a window of `width`.
cv::Mat smoothed_within(const cv::Mat& j, const cv::Mat& regions, int width) {
  cv::Mat result = cv::Mat::zeros(j.size(), CV_32F);
  tbb::parallel_for(0, j.rows, [&](int y) {
    const int top = std::max(0, y - width / 2), bottom = std::min(j.rows - 1, y + width / 2);
    for (int x = 0; x < j.cols; ++x) {
      const int region = regions.at<int>(y, x);
      if (!region) continue;
      const int left = std::max(0, x - width / 2), right = std::min(j.cols - 1, x + width / 2);
      float sum = 0;
      int count = 0;
      for (int v = top; v <= bottom; ++v) {
        const auto* values = j.ptr<float>(v);
        const auto* of = regions.ptr<int>(v);
        for (int u = left; u <= right; ++u) {
          sum += of[u] == region ? values[u] : 0.f;
          count += of[u] == region;
        }
      }
      result.at<float>(y, x) = sum / static_cast<float>(count);
    }
  });
  return result;
}

}  // namespace

cv::Mat j_image(const cv::Mat& class_map, int class_count, const cv::Mat& region_map, int scale) {
  const cv::Mat classes = class_map.isContinuous() ? class_map : class_map.clone();
  const cv::Mat regions = region_map.isContinuous() ? region_map : region_map.clone();
  const int step = 1 << (scale - 1), rows = classes.rows, columns = classes.cols;
  const auto samples = window(step, columns);
  const int* const region_at = regions.ptr<int>();
  const int* const class_at = classes.ptr<int>();
  cv::Mat j = cv::Mat::zeros(classes.size(), CV_32F);
  tbb::parallel_for(tbb::blocked_range<int>(0, rows, 16), [&](const tbb::blocked_range<int>& block) {
    std::vector<std::uint32_t> sums(static_cast<std::size_t>(std::max(1, class_count)), 0);
    std::vector<int> seen(samples.size() + 1);
    for (int y = block.begin(); y < block.end(); ++y) {
      for (int x = 0; x < columns; ++x) {
        const int here = y * columns + x, region = region_at[here];
        if (!region) continue;
        const bool inside = std::min({x, y, columns - 1 - x, rows - 1 - y}) >= kHalf * step;
        int count = 0, squares = 0;
        for (const Sample& sample : samples) {
          const int at =
              inside ? here + sample.offset
                     : std::clamp(y + sample.dy, 0, rows - 1) * columns + std::clamp(x + sample.dx, 0, columns - 1);
          if (region_at[at] != region) continue;
          const int of = class_at[at];
          seen[count] = of;
          count += sums[of] == 0;
          sums[of] += sample.word;
          squares += sample.squares;
        }
        j.at<float>(y, x) = j_of_sums(sums, seen, count, squares);
      }
    }
  });
  if (step == 1) return j;
  return smoothed_within(smoothed_within(j, regions, step + 1), regions, step + 1);
}

double j_of(const cv::Mat& classes) {
  struct Sums {
    double n = 0, x = 0, y = 0;
  };
  std::map<int, Sums> sums;
  Sums all;
  double squares = 0;
  for (int y = 0; y < classes.rows; ++y) {
    for (int x = 0; x < classes.cols; ++x) {
      const int of = classes.at<int>(y, x);
      if (of < 0) continue;
      for (Sums* each : {&sums[of], &all}) each->n += 1, each->x += x, each->y += y;
      squares += static_cast<double>(x) * x + static_cast<double>(y) * y;
    }
  }
  if (!(all.n > 0)) return 0;
  double within = squares;
  for (const auto& [of, s] : sums) within -= (s.x * s.x + s.y * s.y) / s.n;
  const double total = squares - (all.x * all.x + all.y * all.y) / all.n;
  if (total < kNoScatter) return 0;
  return within < kNoScatter ? kMostJ : (total - within) / within;
}

}  // namespace dressform
