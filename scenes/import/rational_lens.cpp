#include "scenes/import/rational_lens.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "scenes/small_solvers.h"

namespace dressform {
namespace {

constexpr double kStep = 1e-3;  // of the radius at focal length 1: half a pixel of any of these images

double factor(const std::array<double, 6>& k, double s) {
  return (1 + s * (k[0] + s * (k[1] + s * k[2]))) / (1 + s * (k[3] + s * (k[4] + s * k[5])));
}

// Radii, at focal length 1, of what the image shows: up to its farthest corner, or to where the lens turns back.
std::vector<double> radii_of(const Camera& camera, const RationalLens& lens, double largest_radius) {
  const double x = std::max(camera.cx, camera.width - 1 - camera.cx) / camera.fx;
  const double y = std::max(camera.cy, camera.height - 1 - camera.cy) / camera.fy;
  std::vector<double> radii;
  double before = 0;
  for (double r = kStep; r <= largest_radius; r += kStep) {
    const double distorted = r * factor(lens.radial, r * r);
    if (distorted > std::hypot(x, y) || distorted <= before) break;
    before = distorted;
    radii.push_back(r);
  }
  return radii;
}

}  // namespace

PolynomialFit with_polynomial_lens(const Camera& camera, const RationalLens& lens, double largest_radius) {
  PolynomialFit fit{camera, 0, 0};
  const auto radii = radii_of(camera, lens, largest_radius);
  if (radii.size() < 4) {  // it turns back at once
    fit.rms_px = fit.worst_px = std::numeric_limits<double>::infinity();
    return fit;
  }
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  const auto powers = [](double r) { return Eigen::Vector4d(r, r * r * r, std::pow(r, 5), std::pow(r, 7)); };
  double area = 0;
  for (const double r : radii) {  // each ring by its area, which is as its radius
    normal += r * powers(r) * powers(r).transpose();
    right += r * r * factor(lens.radial, r * r) * powers(r);
    area += r;
  }
  const Eigen::Vector4d found = solve_symmetric(normal, right);
  for (const double r : radii) {
    const double off_px = camera.fx * (powers(r).dot(found) - r * factor(lens.radial, r * r));
    fit.rms_px += r / area * off_px * off_px;
    fit.worst_px = std::max(fit.worst_px, std::abs(off_px));
  }
  fit.rms_px = std::sqrt(fit.rms_px);
  fit.camera.fx *= found[0], fit.camera.fy *= found[0];
  fit.camera.distortion = {found[1] / found[0], found[2] / found[0], lens.p1 / found[0], lens.p2 / found[0],
                           found[3] / found[0]};
  return fit;
}

}  // namespace dressform
