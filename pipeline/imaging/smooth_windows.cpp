#include "pipeline/imaging/smooth_windows.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "scenes/small_solvers.h"

namespace dressform {
namespace {

constexpr double kBend = 0.8;       // least part of the variance that bends may not explain
constexpr double kOutstanding = 5;  // largest residual, in deviations

// Coefficients of the least squares fit of `values`, and the sum of squared residuals of inverse depth.
struct Fit {
  Eigen::VectorXd coefficients;
  Eigen::VectorXd residuals;
};
Fit fit(const Eigen::MatrixXd& terms, const Eigen::VectorXd& values) {
  Fit result;
  result.coefficients = solve_symmetric(terms.transpose() * terms, terms.transpose() * values);
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

}  // namespace

std::vector<SmoothWindow> smooth_windows(const cv::Mat& depth_mm, const Camera& camera, int edge_px) {
  return smooth_windows_on(normalized_grid(camera), depth_mm, edge_px);
}

std::vector<SmoothWindow> smooth_windows_on(const cv::Mat& grid, const cv::Mat& depth_mm, int edge_px) {
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

}  // namespace dressform
