#include "pipeline/imaging/sensor_noise.h"

#include "pipeline/imaging/smooth_windows.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr std::size_t kLeastWindows = 12;  // fewer say nothing
// And less: the curve is of a white target. Phase noise goes with the amplitude; at an albedo of .2 it is three times
// as much, and what a room's walls reflect says nothing of the cloth's.
constexpr double kAsTheCurve = 3.5;
constexpr double kMost = 8;  // more is a rough surface, not noise
constexpr int kFrames = 6;   // of a scan: some hundred windows each

}  // namespace

double depth_noise_factor(const std::vector<cv::Mat>& depth_mm, const Camera& camera) {
  std::vector<double> factors;
  cv::Mat grid;  // takes longer than an image's windows
  for (const auto& image : depth_mm) {
    if (image.type() != CV_16U || image.cols != camera.width || image.rows != camera.height) continue;
    if (grid.empty()) grid = normalized_grid(camera);
    for (const auto& window : smooth_windows_on(grid, image))
      factors.push_back(1e-3 * window.sigma_mm / axial_noise_m(window.z_m, std::cos(window.theta_rad)));
  }
  if (factors.size() < kLeastWindows) return 1;
  const double factor = median(std::move(factors));
  return factor < kAsTheCurve ? 1 : std::min(factor, kMost);
}

std::vector<cv::Mat> frames_for_noise(const std::vector<cv::Mat>& scan_mm) {
  const int count = static_cast<int>(scan_mm.size()), kept = std::min(kFrames, count);
  std::vector<cv::Mat> frames;
  for (int i = 0; i < kept; ++i) frames.push_back(scan_mm[(2 * i + 1) * count / (2 * kept)]);
  return frames;
}

}  // namespace dressform
