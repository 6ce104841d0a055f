#include "eval/inspect/depth_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr int kLeastRun = 5;

// A window's deviation over time instead of space; nothing where it has holes or moved.
std::optional<SmoothWindow> over_time(SmoothWindow window, const std::vector<cv::Mat>& frames) {
  const cv::Rect& box = window.pixels;
  double variance = 0;
  std::vector<double> means(frames.size());
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x) {
      double sum = 0, squares = 0;
      for (std::size_t f = 0; f < frames.size(); ++f) {
        const double mm = frames[f].at<std::uint16_t>(y, x);
        if (mm == 0) return {};
        sum += mm, squares += mm * mm;
        means[f] += mm / box.area();
      }
      variance += (squares - sum * sum / frames.size()) / (frames.size() - 1);
    }
  double mean = 0, drift = 0;  // what the whole window does together is not its pixels' noise
  for (const double each : means) mean += each / means.size();
  for (const double each : means) drift += (each - mean) * (each - mean) / (means.size() - 1);
  window.sigma_mm = std::sqrt(std::max(0.0, variance / box.area() - drift));
  const auto [least, most] = std::minmax_element(means.begin(), means.end());
  if (*most - *least > 2 * window.sigma_mm + 2) return {};
  return window;
}

// How much of the view moved from one frame to the other, in parts of what any of these sensors' noise may do: the
// middle of the pixels and nine tenths of them.
bool is_still(const cv::Mat& before, const cv::Mat& after) {
  std::vector<double> moved;
  for (int y = 0; y < before.rows; y += 3)
    for (int x = 0; x < before.cols; x += 3) {
      const int a = before.at<std::uint16_t>(y, x), b = after.at<std::uint16_t>(y, x);
      if (a && b) moved.push_back(std::abs(a - b) / (1 + 2e-6 * a * a));
    }
  if (moved.size() < 100) return false;
  std::sort(moved.begin(), moved.end());
  return moved[moved.size() / 2] <= 1 && moved[moved.size() * 9 / 10] <= 3;
}

}  // namespace

std::vector<SmoothWindow> windows_over_time(const std::vector<cv::Mat>& frames, const Camera& camera, int edge_px) {
  std::vector<SmoothWindow> windows;
  if (frames.size() < 2) return windows;
  for (const auto& window : smooth_windows(frames.front(), camera, edge_px))
    if (const auto timed = over_time(window, frames)) windows.push_back(*timed);
  return windows;
}

std::vector<StillRun> still_runs(const std::vector<cv::Mat>& frames) {
  std::vector<StillRun> runs;
  for (int first = 0; first < static_cast<int>(frames.size());) {
    int end = first + 1;
    while (end < static_cast<int>(frames.size()) && is_still(frames[first], frames[end])) ++end;
    if (end - first >= kLeastRun) runs.push_back({first, end - first});
    first = end;
  }
  return runs;
}

double median_sigma_mm(const std::vector<SmoothWindow>& windows) {
  std::vector<double> values;
  for (const auto& window : windows) values.push_back(window.sigma_mm);
  return median_or(std::move(values), std::numeric_limits<double>::quiet_NaN());
}

}  // namespace dressform
