#pragma once
#include <algorithm>
#include <cmath>

namespace dressform {

// Expected noise of a time-of-flight sensor along its optical axis, metres, for a surface at z_m whose normal makes the
// angle with the given cosine with the line of sight (Fankhauser et al., "Kinect v2 for mobile robot navigation", ICAR
// 2015). The angle is cut at 85 degrees.
inline double axial_noise_m(double z_m, double cosine) {
  const double theta = std::acos(std::clamp(cosine, 0.0871557, 1.0));
  const double slope = theta / (M_PI / 2 - theta);
  return 1e-3 * (1.5 - 0.5 * z_m + 0.3 * z_m * z_m + 0.1 * z_m * std::sqrt(std::max(z_m, 0.0)) * slope * slope);
}

}  // namespace dressform
