#include "eval/inspect/depth_noise.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double kBend = 0.8;       // least part of the variance that bends may not explain
constexpr double kOutstanding = 5;  // largest residual, in deviations
constexpr int kLeastRun = 5;

// Coefficients of the least squares fit of `values`, and the sum of squared residuals of inverse depth.
struct Fit {
  Eigen::VectorXd coefficients;
  Eigen::VectorXd residuals;
};
Fit fit(const Eigen::MatrixXd& terms, const Eigen::VectorXd& values) {
  Fit result;
  result.coefficients = (terms.transpose() * terms).ldlt().solve(terms.transpose() * values);
  result.residuals = values - terms * result.coefficients;
  return result;
}

class WindowFitter {
 public:
  WindowFitter(const cv::Mat& depth_mm, const cv::Mat& grid, int edge)
      : depth_mm_(depth_mm), grid_(grid), edge_(edge) {}

  std::optional<SmoothWindow> window(int left, int top) const {
    const int count = edge_ * edge_;
    Eigen::VectorXd inverse(count);
    Eigen::MatrixXd terms(count, 6);
    const cv::Vec2d middle = grid_.at<cv::Vec2d>(top + edge_ / 2, left + edge_ / 2);
    const double unit = std::abs(grid_.at<cv::Vec2d>(top, left + edge_ - 1)[0] - grid_.at<cv::Vec2d>(top, left)[0]) / 2;
    for (int y = 0, i = 0; y < edge_; ++y)
      for (int x = 0; x < edge_; ++x, ++i) {
        const int mm = depth_mm_.at<std::uint16_t>(top + y, left + x);
        if (mm == 0) return {};
        const cv::Vec2d at = grid_.at<cv::Vec2d>(top + y, left + x);
        const double u = (at[0] - middle[0]) / unit, v = (at[1] - middle[1]) / unit;
        inverse[i] = 1000.0 / mm;
        terms.row(i) << 1, u, v, u * u, u * v, v * v;
      }
    const Fit plane = fit(terms.leftCols<3>(), inverse), bent = fit(terms, inverse);
    const double flat = plane.residuals.squaredNorm(), rest = bent.residuals.squaredNorm();
    if (!(plane.coefficients[0] > 0) || rest < kBend * flat) return {};
    return described(cv::Rect(left, top, edge_, edge_), plane, middle, unit);
  }

 private:
  std::optional<SmoothWindow> described(const cv::Rect& pixels, const Fit& plane, const cv::Vec2d& middle,
                                        double unit) const {
    SmoothWindow window;
    window.pixels = pixels;
    window.z_m = 1 / plane.coefficients[0];
    const double to_mm = -1000 * window.z_m * window.z_m;  // of inverse depth
    const Eigen::VectorXd residuals = to_mm * plane.residuals;
    window.sigma_mm = std::sqrt(residuals.squaredNorm() / (residuals.size() - 3));
    if (residuals.cwiseAbs().maxCoeff() > kOutstanding * window.sigma_mm + 1) return {};
    // 1/z = a x + b y + c of a plane n.p = d: (a, b, c) = n / d.
    const double a = plane.coefficients[1] / unit, b = plane.coefficients[2] / unit;
    const Vector3d normal(a, b, plane.coefficients[0] - a * middle[0] - b * middle[1]), ray(middle[0], middle[1], 1);
    window.theta_rad = std::acos(std::clamp(std::abs(normal.normalized().dot(ray.normalized())), 0.0, 1.0));
    for (int lag = 0; lag <= kNoiseLags; ++lag) {
      double sum = 0;
      for (int y = 0; y < edge_; ++y)
        for (int x = 0; x + lag < edge_; ++x) sum += residuals[y * edge_ + x] * residuals[y * edge_ + x + lag];
      window.products_mm2[lag] = sum / (edge_ * (edge_ - lag));
    }
    return window;
  }

  const cv::Mat& depth_mm_;
  const cv::Mat& grid_;
  int edge_;
};

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

std::vector<SmoothWindow> smooth_windows(const cv::Mat& depth_mm, const Camera& camera, int edge_px) {
  const cv::Mat grid = normalized_grid(camera);
  const WindowFitter fitter(depth_mm, grid, edge_px);
  const int rows = depth_mm.rows / edge_px, columns = depth_mm.cols / edge_px;
  std::vector<std::optional<SmoothWindow>> found(static_cast<std::size_t>(rows) * columns);
  tbb::parallel_for(0, rows, [&](int row) {
    for (int column = 0; column < columns; ++column)
      found[static_cast<std::size_t>(row) * columns + column] = fitter.window(column * edge_px, row * edge_px);
  });
  std::vector<SmoothWindow> windows;
  for (const auto& window : found)
    if (window) windows.push_back(*window);
  return windows;
}

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
