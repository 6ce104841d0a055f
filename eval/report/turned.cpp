#include "eval/report/turned.h"

#include <cmath>

namespace dressform {

double front_heading(const Reconstruction& reconstruction) {
  const auto& poses = reconstruction.registration.get().model_from_sensor;
  for (const auto& sensor : reconstruction.sensors)
    if (const auto pose = poses.find(sensor); pose != poses.end())
      return std::atan2(pose->second.translation().x(), pose->second.translation().z());
  return 0;
}

double scan_heading(const BodyModel& model) {
  if (model.model_from_frame.empty()) return 0;
  const Vector3d at = model.model_from_frame.front().translation();
  return std::atan2(at.x(), at.z());
}

Vector3d turned(const Vector3d& point, double heading) {
  return Eigen::AngleAxisd(-heading, Vector3d::UnitY()) * point;
}

Mesh turned(const Mesh& mesh, double heading) {
  Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
  turn.topLeftCorner<3, 3>() = Eigen::AngleAxisd(-heading, Vector3d::UnitY()).toRotationMatrix();
  return transformed(mesh, turn);
}

TexturedMesh turned(const TexturedMesh& mesh, double heading) {
  return {turned(mesh.mesh, heading), mesh.corner_uv, mesh.texture};
}

}  // namespace dressform
