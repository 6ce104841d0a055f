#pragma once
#include <algorithm>
#include <cmath>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "scenes/camera.h"
#include "scenes/devices/noise.h"

namespace dressform {

// Expected noise of depth along the optical axis, metres, for a surface at z_m whose normal makes the angle with the
// given cosine with the line of sight: Fankhauser's curve of the Kinect v2, whatever sensor it is. It grows without
// bound towards 90 degrees: the angle is cut at 85. Of a session's sensor it is depth_noise_factor times as much.
inline double axial_noise_m(double z_m, double cosine) {
  constexpr double kCosineOf85Degrees = 0.0871557;
  return 1e-3 * fankhauser_sigma_mm(std::max(z_m, 0.0), std::acos(std::clamp(cosine, kCosineOf85Degrees, 1.0)));
}

// How many times noisier a sensor is than axial_noise_m says, from what it measured itself: the middle, over the smooth
// windows of some of its depth images (uint16 millimetres), of the deviation about the window's plane over the curve's.
// Images of another size than the camera's are passed over. 1 where few windows are smooth, and below 3.5: reflectance
// alone may do as much.
double depth_noise_factor(const std::vector<cv::Mat>& depth_mm, const Camera& camera);

// Some frames of a scan, evenly spread: enough to tell its sensor's noise by.
std::vector<cv::Mat> frames_for_noise(const std::vector<cv::Mat>& scan_mm);

}  // namespace dressform
