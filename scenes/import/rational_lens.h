#pragma once
#include <array>

#include "scenes/camera.h"

namespace dressform {

// The rational lens model of OpenCV and of the Azure Kinect SDK: radius times (1 + k1 s + k2 s^2 + k3 s^3) /
// (1 + k4 s + k5 s^2 + k6 s^3), s the squared radius at focal length 1, and two tangential coefficients.
struct RationalLens {
  std::array<double, 6> radial{};
  double p1 = 0, p2 = 0;
};

// A session's cameras have a polynomial lens: the one that comes nearest to `lens` over the image of `camera`, where
// the lens still sees (radius up to `largest_radius`), by least squares over the image's area; the focal lengths take
// up what a polynomial that starts at 1 cannot. How far it is off: pixels, root mean square and largest;
// infinite where the lens shows nothing of the image.
struct PolynomialFit {
  Camera camera;
  double rms_px = 0, worst_px = 0;
};
PolynomialFit with_polynomial_lens(const Camera& camera, const RationalLens& lens, double largest_radius);

}  // namespace dressform
