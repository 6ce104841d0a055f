#pragma once
#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "scenes/camera.h"

namespace dressform {

constexpr int kNoiseLags = 3;

// A smooth piece of surface that fills a square of pixels, and the noise on it.
struct SmoothWindow {
  cv::Rect pixels;
  double z_m = 0, theta_rad = 0;  // distance along the axis; angle between its normal and the line of sight
  double sigma_mm = 0;            // of depth about its plane
  std::array<double, kNoiseLags + 1> products_mm2{};  // mean product of residuals so many columns apart
};

// Squares of `edge_px` x `edge_px`, side by side, all of whose pixels have depth and follow a plane: inverse depth is
// affine in the image plane, bends are no more than noise, nothing sticks out. What the plane cannot explain is noise:
// it is an upper bound on surfaces that are not smooth themselves, and slow parts of the noise go into the plane.
std::vector<SmoothWindow> smooth_windows(const cv::Mat& depth_mm, const Camera& camera, int edge_px = 15);

// The same for many images of one camera: `grid` is normalized_grid(camera).
std::vector<SmoothWindow> smooth_windows_on(const cv::Mat& grid, const cv::Mat& depth_mm, int edge_px = 15);

}  // namespace dressform
