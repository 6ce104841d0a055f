#pragma once
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// A smooth map of space that takes control points to target points: radial basis functions of r (or r^3, r^2 log r)
// with an affine part (Carr et al., SIGGRAPH 2001). All kernels grow with distance, so that cloth far from every
// control still moves with the affine part instead of staying where it was.
class RbfField {
 public:
  enum class Kernel { linear, cubic, thin_plate };  // r, r^3, r^2 log r

  // Controls closer to one another than a millimetre are merged. `smoothing` (metres for r) lets the map miss the
  // targets a little in exchange for smoothness; 0 interpolates. Fewer than four controls give a translation, and
  // controls in a plane the least affine change that fits. Throws std::invalid_argument if the lists differ in length.
  RbfField(const std::vector<Vector3d>& controls, const std::vector<Vector3d>& targets, Kernel kernel,
           double smoothing);

  Vector3d operator()(const Vector3d& point) const;
  std::vector<Vector3d> operator()(const std::vector<Vector3d>& points) const;  // on all threads

  int control_points() const { return static_cast<int>(centers_.size()); }
  double largest_residual_m() const { return largest_residual_m_; }  // over the controls

 private:
  void solve(const std::vector<Vector3d>& displacements, double smoothing);

  Kernel kernel_;
  std::vector<Vector3d> centers_, weights_;
  Eigen::Matrix<double, 3, 4> affine_ = Eigen::Matrix<double, 3, 4>::Zero();  // displacement = affine * (p - origin, 1)
  Vector3d origin_ = Vector3d::Zero();
  double largest_residual_m_ = 0;
};

}  // namespace dressform
