#pragma once
#include <cmath>
#include <functional>
#include <optional>

#include "pipeline/geometry/mesh_query.h"
#include "pipeline/texture/texture.h"

namespace dressform {

// For tests: an upright tube of known print, photographed by four distorted cameras, and what the stages before
// texture would hand on.
struct TubeScene {
  using Print = std::function<cv::Vec3f(double turn, double height)>;  // BGR levels; turn -pi..pi (0: +z, pi/2: +x)

  CaptureSession session;
  Calibration calibration;
  BodyModel naked;
  Registration registration;
  FilledViews filled;
  OpenGarments opened;
};

inline Mesh tube(double radius, double low, double high, int sectors, int rings) {
  Mesh mesh;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double turn = 2 * M_PI * j / sectors;
      mesh.vertices.push_back({radius * std::sin(turn), high + (low - high) * i / rings, radius * std::cos(turn)});
    }
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const int a = i * sectors + j, b = i * sectors + (j + 1) % sectors, c = a + sectors, d = b + sectors;
      mesh.triangles.push_back({a, c, d});
      mesh.triangles.push_back({a, d, b});
    }
  return mesh;
}

inline Camera tube_camera(double scale) {
  Camera camera;
  camera.width = 1920;
  camera.height = 1080;
  camera.fx = 1060;
  camera.fy = 1054;
  camera.cx = 955;
  camera.cy = 524;
  camera.distortion = {0.0563, -0.0742, 0.00143, -0.0017, 0.0241};
  return camera.scaled(scale);
}

// Colour and mask of a garment as a camera sees it, `hidden_by` in front in grey.
inline FilledGarment photograph(const Camera& camera, const Isometry3d& model_from_camera, const MeshQuery& garment,
                                const MeshQuery& hidden_by, const TubeScene::Print& print, double gain) {
  FilledGarment shot;
  shot.color = cv::Mat(camera.height, camera.width, CV_8UC3, cv::Scalar(30, 200, 30));
  shot.mask = cv::Mat(camera.height, camera.width, CV_8UC1, cv::Scalar(0));
  const auto level = [gain](float value) {
    return cv::saturate_cast<uchar>(255 * std::pow(gain * std::pow(value / 255.0, 2.2), 1 / 2.2));
  };
  const Vector3d eye = model_from_camera.translation();
  for (int y = 0; y < camera.height; ++y)
    for (int x = camera.width / 4; x < camera.width * 3 / 4; ++x) {
      const Vector2d ideal = camera.normalized({x, y});
      const Vector3d direction = model_from_camera.linear() * Vector3d(ideal.x(), ideal.y(), 1);
      const auto hit = garment.first_hit(eye, direction), before = hidden_by.first_hit(eye, direction);
      if (before && (!hit || before->distance < hit->distance)) shot.color.at<cv::Vec3b>(y, x) = {255, 0, 255};
      if (!hit || (before && before->distance < hit->distance)) continue;
      const cv::Vec3f c = print(std::atan2(hit->point.x(), hit->point.z()), hit->point.y());
      shot.color.at<cv::Vec3b>(y, x) = {level(c[0]), level(c[1]), level(c[2])};
      shot.mask.at<uchar>(y, x) = 255;
    }
  return shot;
}

// Sensors k1 to k4 stand at +z, +x, -z and -x, 2.1 m away. `gains`: linear exposure of each. `obstacle` is part of the
// naked body.
inline TubeScene tube_scene(const TubeScene::Print& print, double scale = 0.4, const std::vector<double>& gains = {},
                            const Mesh& obstacle = {}) {
  TubeScene scene;
  scene.opened.garments["top"].mesh = tube(0.2, 0.9, 1.5, 72, 40);
  scene.naked.body = obstacle;
  const MeshQuery garment(scene.opened.garments["top"].mesh), hidden_by(obstacle);
  for (int i = 0; i < 4; ++i) {
    const std::string name = "k" + std::to_string(i + 1);
    scene.session.sensors.push_back(name);
    SensorCalibration sensor;
    sensor.color = tube_camera(scale);
    sensor.color_from_ir.translation() = Vector3d(-0.052, 0, 0);
    Isometry3d model_from_ir = Isometry3d::Identity();
    model_from_ir.linear() =
        (Eigen::AngleAxisd(i * M_PI / 2, Vector3d::UnitY()) * Eigen::AngleAxisd(M_PI, Vector3d::UnitX()))
            .toRotationMatrix();
    model_from_ir.translation() = model_from_ir.linear() * Vector3d(0, 0, -2.1) + Vector3d(0, 1.25, 0);
    scene.calibration.sensors[name] = sensor;
    scene.registration.model_from_sensor[name] = model_from_ir;
    scene.registration.converged[name] = true;
    scene.filled.garments["top"][name] = photograph(*sensor.color, model_from_ir * sensor.color_from_ir.inverse(),
                                                    garment, hidden_by, print, gains.empty() ? 1 : gains[i]);
  }
  return scene;
}

}  // namespace dressform
