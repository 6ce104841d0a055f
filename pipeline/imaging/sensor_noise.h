#pragma once
#include <algorithm>
#include <cmath>

#include "scenes/devices/noise.h"

namespace dressform {

// Expected noise of depth along the optical axis, metres, for a surface at z_m whose normal makes the angle with the
// given cosine with the line of sight: Fankhauser's curve of the Kinect v2, whatever sensor it is. It grows without
// bound towards 90 degrees: the angle is cut at 85.
inline double axial_noise_m(double z_m, double cosine) {
  constexpr double kCosineOf85Degrees = 0.0871557;
  return 1e-3 * fankhauser_sigma_mm(std::max(z_m, 0.0), std::acos(std::clamp(cosine, kCosineOf85Degrees, 1.0)));
}

}  // namespace dressform
