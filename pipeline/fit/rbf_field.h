#pragma once
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// A smooth map of space that takes control points to target points: radial basis functions of r (or r^3, r^2 log r)
// with an affine part (Carr et al., SIGGRAPH 2001), which grow with distance; or kernels that fall off: a Gaussian, and
// Wendland's C2 function of compact support (Advances in Computational Mathematics 1995), which leave the affine part
// alone where no control is near.
class RbfField {
 public:
  // r, r^3, r^2 log r, exp(-(r / radius)^2), (1 - r / radius)^4 (4 r / radius + 1)
  enum class Kernel { linear, cubic, thin_plate, gaussian, wendland };

  // Controls closer to one another than a millimetre are merged. `smoothing` (metres for r, none for kernels that fall
  // off, which are 1 at r = 0) lets the map miss the targets a little in exchange for smoothness; 0 interpolates.
  // `radius_m`: of kernels that fall off. Fewer than four controls give a translation, and
  // controls in a plane the least affine change that fits. Throws std::invalid_argument if the lists differ in length.
  RbfField(const std::vector<Vector3d>& controls, const std::vector<Vector3d>& targets, Kernel kernel, double smoothing,
           double radius_m = 0.3);

  Vector3d operator()(const Vector3d& point) const;
  std::vector<Vector3d> operator()(const std::vector<Vector3d>& points) const;  // on all threads

  int control_points() const { return static_cast<int>(centers_.size()); }
  double largest_residual_m() const { return largest_residual_m_; }  // over the controls

 private:
  void solve(const std::vector<Vector3d>& displacements, double smoothing);

  Kernel kernel_;
  double radius_m_;
  std::vector<Vector3d> centers_, weights_;
  Eigen::Matrix<double, 3, 4> affine_ = Eigen::Matrix<double, 3, 4>::Zero();  // displacement = affine * (p - origin, 1)
  Vector3d origin_ = Vector3d::Zero();
  double largest_residual_m_ = 0;
};

}  // namespace dressform
