#include "scenes/calibration_toml.h"

#include "scenes/scene_fields.h"

namespace dressform {
namespace {

Camera read_camera(TomlSection& section) {
  Camera camera;
  fields(section, camera);
  for (const char* key : {"width", "height", "fx", "fy", "cx", "cy"})
    if (!section.has(key)) section.fail("", std::string("found no ") + key + "; expected it in every camera");
  Eigen::VectorXd distortion = Eigen::VectorXd::Zero(5);
  section.vector("distortion", distortion, 5, -10, 10, "");
  for (int i = 0; i < 5; ++i) camera.distortion[i] = distortion[i];
  return camera;
}

}  // namespace

Isometry3d read_step(TomlSection& section) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vector3d translation = Vector3d::Zero();
  section.rotation("rotation", rotation);
  section.vector3("translation_m", translation, -10, 10, "m");
  Isometry3d step = Isometry3d::Identity();
  step.linear() = rotation;
  step.translation() = translation;
  return step;
}

SensorCalibration read_calibration(TomlSection& section) {
  SensorCalibration calibration;
  calibration.model = "kinect_v2";
  section("model", calibration.model, {}, "");
  section("depth_offset_m", calibration.depth_offset_m, -0.2, 0.2, "m", "");
  if (!section.has("ir")) section.fail("", "found no ir camera; expected one (colour may be absent)");
  section.child("ir", [&](TomlSection& ir) { calibration.ir = read_camera(ir); });
  section.child("color", [&](TomlSection& color) { calibration.color = read_camera(color); });
  section.child("color_from_ir", [&](TomlSection& step) { calibration.color_from_ir = read_step(step); });
  return calibration;
}

}  // namespace dressform
