#include "pipeline/surface/depth_noise.h"

#include <algorithm>
#include <cmath>

#include "scenes/statistics.h"

namespace dressform {
namespace {

// Third differences of all runs of four pixels that are of one surface.
void add_differences(const cv::Mat& depth_mm, const cv::Point& step, double jump_mm, std::vector<float>& differences) {
  const int width = depth_mm.cols - 3 * step.x, height = depth_mm.rows - 3 * step.y;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      float z[4];
      bool one_surface = true;
      for (int k = 0; k < 4 && one_surface; ++k) {
        z[k] = depth_mm.at<float>(y + k * step.y, x + k * step.x);
        one_surface = z[k] > 0 && (k == 0 || std::abs(z[k] - z[k - 1]) < jump_mm);
      }
      if (one_surface) differences.push_back(std::abs(z[3] - 3 * z[2] + 3 * z[1] - z[0]));
    }
}

double spread(std::vector<float> magnitudes) {
  constexpr std::size_t kEnough = 300;
  if (magnitudes.size() < kEnough) return 0;
  return kSigmaPerMedianDeviation * median(std::move(magnitudes)) / std::sqrt(20.0);  // 1 + 9 + 9 + 1
}

}  // namespace

double depth_noise_mm(const std::vector<cv::Mat>& images, double jump_mm) {
  std::vector<float> along_rows, along_columns;
  for (const cv::Mat& image : images) {
    const int apart = std::max(1, (3 * image.cols + 256) / 512);
    add_differences(image, {apart, 0}, jump_mm, along_rows);
    add_differences(image, {0, apart}, jump_mm, along_columns);
  }
  const double rows = spread(std::move(along_rows)), columns = spread(std::move(along_columns));
  return rows > 0 && columns > 0 ? std::min(rows, columns) : std::max(rows, columns);
}

}  // namespace dressform
