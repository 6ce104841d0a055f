#pragma once
#include <Eigen/Core>

#include "scenes/camera.h"

namespace dressform {

using Vector9d = Eigen::Matrix<double, 9, 1>;

// Parameters of a camera in the order fx, fy, cx, cy, k1, k2, p1, p2, k3.
Vector9d camera_vector(const Camera& camera);
Camera camera_with(Camera camera, const Vector9d& values);

// Projection with its derivatives.
struct Projection {
  Vector2d pixel;
  Eigen::Matrix<double, 2, 2> by_ideal;   // to the ideal image-plane coordinates (x/z, y/z)
  Eigen::Matrix<double, 2, 9> by_camera;  // to the camera's parameters
};
Projection project_ideal(const Camera& camera, const Vector2d& ideal);

// Derivative of (x/z, y/z) to the point.
Eigen::Matrix<double, 2, 3> ideal_by_point(const Vector3d& point);

inline Eigen::Matrix3d cross_matrix(const Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// The pose moved by a small step in its target frame: rotation vector, then translation.
Isometry3d moved(const Isometry3d& pose, const Eigen::Matrix<double, 6, 1>& step);

}  // namespace dressform
