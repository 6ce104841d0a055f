#pragma once
// A mannequin of capsules in analytic clothes, seen by four depth cameras: known answers for the tests of stages that
// come after segmentation. Model frame = the figure's own: faces +z, stands on y = 0.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "pipeline/fill/fill.h"
#include "pipeline/geometry/lattice.h"
#include "pipeline/geometry/mesh_query.h"
#include "scenes/random.h"

namespace dressform::figure {

inline double capsule(const Vector3d& p, const Vector3d& a, const Vector3d& b, double radius) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm() - radius;
}

// Signed distances. side: +1 left, -1 right.
inline Vector3d shoulder(double side) { return {side * 0.17, 1.40, 0}; }
inline Vector3d hand(double side) { return {side * 0.36, 0.75, 0}; }
inline double arm(const Vector3d& p, double side) { return capsule(p, shoulder(side), hand(side), 0.045); }
inline double leg(const Vector3d& p, double side) {
  return std::min(capsule(p, {side * 0.10, 0.06, 0}, {side * 0.09, 0.95, 0}, 0.07),
                  capsule(p, {side * 0.10, 0.04, 0}, {side * 0.10, 0.04, 0.14}, 0.04));
}
inline double torso(const Vector3d& p) {
  return std::min(capsule(p, {0, 1.0, 0}, {0, 1.35, 0}, 0.15), capsule(p, {0, 1.4, 0}, {0, 1.7, 0}, 0.06));
}
inline double body(const Vector3d& p) {
  double d = std::min(torso(p), (p - Vector3d(0, 1.68, 0)).norm() - 0.10);
  for (const double side : {-1.0, 1.0}) d = std::min({d, arm(p, side), leg(p, side)});
  return d;
}
inline double along_arm(const Vector3d& p, double side) {
  return (p - shoulder(side)).dot((hand(side) - shoulder(side)).normalized());
}

struct Clothes {
  double sleeve_m = 0.30;  // from the shoulder's centre to the cuff
  double neck_y = 1.48, hem_y = 0.98;
  double waist_y = 1.08, ankle_y = 0.25;
  bool skirt = false;
  double shirt_ease_m = 0.020, bottom_ease_m = 0.010;
};

// Negative inside the shirt taken as a solid, flat at its ends.
inline double shirt(const Vector3d& p, const Clothes& c) {
  double d = std::max({torso(p) - c.shirt_ease_m, p.y() - c.neck_y, c.hem_y - p.y()});
  for (const double side : {-1.0, 1.0})
    d = std::min(d, std::max(arm(p, side) - c.shirt_ease_m, along_arm(p, side) - c.sleeve_m));
  return d;
}
inline double bottom(const Vector3d& p, const Clothes& c) {
  double d = std::min(leg(p, 1), leg(p, -1)) - c.bottom_ease_m;
  if (c.skirt) d = std::hypot(p.x(), p.z()) - (0.19 + 0.10 * (c.waist_y - p.y()));
  d = std::min(d, torso(p) - c.bottom_ease_m);
  return std::max({d, p.y() - c.waist_y, c.ankle_y - p.y()});
}
// Whether a point of a garment lies on the flat end of the solid, which is no cloth.
inline bool on_end(const Vector3d& p, Label label, const Clothes& c) {
  constexpr double kThin_m = 1e-3;
  if (label == Label::bottom) return p.y() > c.waist_y - kThin_m || p.y() < c.ankle_y + kThin_m;
  const double side = p.x() > 0 ? 1 : -1;
  if (arm(p, side) < torso(p)) return along_arm(p, side) > c.sleeve_m - kThin_m;
  return p.y() > c.neck_y - kThin_m || p.y() < c.hem_y + kThin_m;
}

template <class F>
Mesh surface_of(const Vector3d& low, const Vector3d& high, double step_m, F&& distance) {
  const Lattice lattice = make_lattice(low, high, 0.05, step_m);
  std::vector<float> field(lattice.count());
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = static_cast<float>(distance(lattice.point(i)));
  return lattice_surface(lattice, field);
}
inline Mesh body_mesh(double step_m = 0.012) {
  return surface_of({-0.45, 0, -0.25}, {0.45, 1.8, 0.25}, step_m, [](const Vector3d& p) { return body(p); });
}

// What the stages after segmentation are given.
struct Capture {
  Clothes clothes;
  CaptureSession session;
  Calibration calibration;
  BodyModel naked;
  KnownBody body;  // the same, with its landmarks
  Registration registration;
  Segmentation segmentation;
  FilledViews filled;
};

inline Camera camera(int width, int height, double focal) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = focal;
  camera.cx = (width - 1) / 2.0;
  camera.cy = (height - 1) / 2.0;
  return camera;
}

// A sphere-traced pixel: depth along the axis (0 = nothing) and what is there.
inline std::pair<double, Label> look(const Camera& camera, const Isometry3d& model_from_camera, const Clothes& c, int x,
                                     int y) {
  const Vector3d ray = camera.unproject({static_cast<double>(x), static_cast<double>(y)}, 1.0);
  const Vector3d direction = model_from_camera.linear() * ray.normalized();
  double t = 1.0;
  for (int i = 0; i < 200 && t < 4; ++i) {
    const Vector3d p = model_from_camera.translation() + t * direction;
    const double d[3] = {body(p), shirt(p, c), bottom(p, c)};
    const double nearest = std::min({d[0], d[1], d[2]});
    if (nearest < 2e-4) {
      Label label = Label::skin;
      if (d[2] < 5e-4) label = Label::bottom;
      if (d[1] < 5e-4) label = Label::top;
      if (label != Label::skin && on_end(p, label, c)) label = Label::skin;
      return {t * ray.normalized().z(), label};
    }
    t += std::max(nearest * 0.9, 1e-4);
  }
  return {0, Label::none};
}

// One of four sensors round the figure, quarter turns apart: model from sensor.
inline Isometry3d looking_from_side(int k) {
  Isometry3d model_from_sensor = Isometry3d::Identity();
  model_from_sensor.rotate(Eigen::AngleAxisd(k * M_PI / 2, Vector3d::UnitY()));
  Eigen::Matrix3d facing;
  facing.col(0) = Vector3d(1, 0, 0);
  facing.col(1) = Vector3d(0, -1, 0);
  facing.col(2) = Vector3d(0, 0, -1);
  model_from_sensor.linear() = model_from_sensor.linear() * facing;
  model_from_sensor.translation() =
      Eigen::AngleAxisd(k * M_PI / 2, Vector3d::UnitY()) * Vector3d(0, 0, 2.1) + Vector3d(0, 0.95, 0);
  return model_from_sensor;
}

inline Capture capture(const Clothes& clothes, double noise_m = 0.002, double scale = 0.5, Seed seed = 1) {
  Capture result;
  result.clothes = clothes;
  result.naked.body = body_mesh();
  result.naked.converged = true;
  result.body = known_body(result.naked.body);
  SensorCalibration sensor;
  sensor.ir = camera(static_cast<int>(512 * scale), static_cast<int>(424 * scale), 366 * scale);
  sensor.color = camera(static_cast<int>(960 * scale), static_cast<int>(540 * scale), 530 * scale);
  sensor.color_from_ir.translation() = Vector3d(0.05, 0, 0);
  for (int k = 0; k < 4; ++k) {
    const std::string name = "k" + std::to_string(k + 1);
    const Isometry3d model_from_sensor = looking_from_side(k);
    result.session.sensors.push_back(name);
    result.calibration.sensors[name] = sensor;
    result.registration.model_from_sensor[name] = model_from_sensor;
    result.registration.converged[name] = true;

    cv::Mat depth(sensor.ir.height, sensor.ir.width, CV_16U, cv::Scalar(0));
    std::map<Label, cv::Mat> garment_depth;
    for (const Label label : {Label::top, Label::bottom})
      garment_depth[label] = cv::Mat(depth.size(), CV_32F, cv::Scalar(0));
    for (int y = 0; y < depth.rows; ++y)
      for (int x = 0; x < depth.cols; ++x) {
        auto [z, label] = look(sensor.ir, model_from_sensor, clothes, x, y);
        if (z == 0) {
          depth.at<std::uint16_t>(y, x) = 4200;
          continue;
        }
        z += noise_m * normal(seed, k, static_cast<std::uint64_t>(y) * depth.cols + x);
        depth.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(std::lround(z * 1000));
        if (label == Label::top || label == Label::bottom)
          garment_depth[label].at<float>(y, x) = depth.at<std::uint16_t>(y, x);
      }
    cv::Mat labels(sensor.color->height, sensor.color->width, CV_8U, cv::Scalar(0));
    const Isometry3d model_from_color = model_from_sensor * sensor.color_from_ir.inverse();
    for (int y = 0; y < labels.rows; ++y)
      for (int x = 0; x < labels.cols; ++x)
        labels.at<uchar>(y, x) = static_cast<uchar>(look(*sensor.color, model_from_color, clothes, x, y).second);
    result.session.dressed[name].depth_mm = depth;
    result.session.dressed[name].color = cv::Mat(labels.size(), CV_8UC3, cv::Scalar(60, 90, 120));
    result.segmentation.labels[name] = labels;
    for (const auto& [label, depth_mm] : garment_depth) {
      FilledGarment garment;
      garment.color = result.session.dressed[name].color;
      garment.mask = (labels == static_cast<int>(label));
      garment.depth_mm = depth_mm;
      garment.synthetic = cv::Mat(depth.size(), CV_8U, cv::Scalar(0));
      result.filled.garments[label == Label::top ? "top" : "bottom"][name] = garment;
    }
  }
  result.session.calibration = result.calibration;
  result.segmentation.garments["top"].kind = "shirt";
  result.segmentation.garments["bottom"].kind = clothes.skirt ? "skirt" : "trousers";
  return result;
}

}  // namespace dressform::figure
