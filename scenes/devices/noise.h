#pragma once
#include <cmath>

namespace dressform {

// Published deviations of measured depth along the optical axis, millimetres, of a surface at z_m (> 0) whose normal
// makes the angle theta (below 90 degrees) with the line of sight.

// Kinect v2: Fankhauser et al., "Kinect v2 for mobile robot navigation: evaluation and modeling", ICAR 2015.
inline double fankhauser_sigma_mm(double z_m, double theta_rad) {
  const double slope = theta_rad / (M_PI / 2 - theta_rad);
  return 1.5 - 0.5 * z_m + 0.3 * z_m * z_m + 0.1 * z_m * std::sqrt(z_m) * slope * slope;
}

// Kinect v1: Khoshelham and Elberink, "Accuracy and resolution of Kinect depth data", Sensors 2012. No angle in it.
inline double khoshelham_sigma_mm(double z_m) { return 1.425 * z_m * z_m; }

// Kinect v1: Nguyen, Izadi and Lovell, "Modeling Kinect sensor noise", 3DIMPVT 2012.
inline double nguyen_sigma_mm(double z_m, double theta_rad) {
  const double slope = theta_rad / (M_PI / 2 - theta_rad);
  return 1.2 + 1.9 * (z_m - 0.4) * (z_m - 0.4) + 0.1 / std::sqrt(z_m) * slope * slope;
}

}  // namespace dressform
