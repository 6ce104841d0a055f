#include "pipeline/calibrate/projection.h"

namespace dressform {

Vector9d camera_vector(const Camera& camera) {
  Vector9d values;
  values << camera.fx, camera.fy, camera.cx, camera.cy, camera.distortion[0], camera.distortion[1],
      camera.distortion[2], camera.distortion[3], camera.distortion[4];
  return values;
}

Camera camera_with(Camera camera, const Vector9d& values) {
  camera.fx = values[0], camera.fy = values[1], camera.cx = values[2], camera.cy = values[3];
  for (int i = 0; i < 5; ++i) camera.distortion[i] = values[4 + i];
  return camera;
}

Projection project_ideal(const Camera& camera, const Vector2d& ideal) {
  const double x = ideal.x(), y = ideal.y(), s = x * x + y * y;
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  const double radial = 1 + s * (k1 + s * (k2 + s * k3)), slope = k1 + s * (2 * k2 + 3 * s * k3);
  const double u = x * radial + 2 * p1 * x * y + p2 * (s + 2 * x * x);
  const double v = y * radial + p1 * (s + 2 * y * y) + 2 * p2 * x * y;
  const double fx = camera.fx, fy = camera.fy;
  Projection result;
  result.pixel = {fx * u + camera.cx, fy * v + camera.cy};
  const double mixed = 2 * x * y * slope + 2 * p1 * x + 2 * p2 * y;
  result.by_ideal << fx * (radial + 2 * x * x * slope + 2 * p1 * y + 6 * p2 * x), fx * mixed, fy * mixed,
      fy * (radial + 2 * y * y * slope + 6 * p1 * y + 2 * p2 * x);
  result.by_camera << u, 0, 1, 0, fx * x * s, fx * x * s * s, fx * 2 * x * y, fx * (s + 2 * x * x), fx * x * s * s * s,
      0, v, 0, 1, fy * y * s, fy * y * s * s, fy * (s + 2 * y * y), fy * 2 * x * y, fy * y * s * s * s;
  return result;
}

Eigen::Matrix<double, 2, 3> ideal_by_point(const Vector3d& point) {
  const double w = 1 / point.z();
  Eigen::Matrix<double, 2, 3> result;
  result << w, 0, -point.x() * w * w, 0, w, -point.y() * w * w;
  return result;
}

Isometry3d moved(const Isometry3d& pose, const Eigen::Matrix<double, 6, 1>& step) {
  const Vector3d turn = step.head<3>();
  const double angle = turn.norm();
  Isometry3d result = pose;
  if (angle > 0) result.prerotate(Eigen::AngleAxisd(angle, turn / angle));
  result.pretranslate(Vector3d(step.tail<3>()));
  return result;
}

}  // namespace dressform
