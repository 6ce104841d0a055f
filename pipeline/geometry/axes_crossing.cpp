#include "pipeline/geometry/axes_crossing.h"

#include <Eigen/LU>
#include <cmath>

#include "scenes/small_solvers.h"

namespace dressform {

std::optional<Vector3d> axes_crossing(const std::vector<Isometry3d>& world_from_sensor) {
  constexpr double kLeastDeterminant = 1e-2;  // of two axes: twice the squared sine of their angle, here 4 degrees
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Vector3d vector = Vector3d::Zero();
  for (const Isometry3d& pose : world_from_sensor) {
    const Vector3d axis = pose.linear().col(2);
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axis * axis.transpose();
    matrix += across;
    vector += across * pose.translation();
  }
  if (std::abs(matrix.determinant()) < kLeastDeterminant) return {};
  return Vector3d(solve_symmetric(matrix, vector));
}

}  // namespace dressform
