#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

namespace dressform {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Pinhole camera with Brown-Conrady distortion in OpenCV's order [k1, k2, p1, p2, k3]. Pixel centres are at integer
// coordinates. Camera frame: x right, y down, z forward, metres.
struct Camera {
  int width = 0, height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  std::array<double, 5> distortion{0, 0, 0, 0, 0};

  // Pixel (distorted) of a point in the camera frame with z > 0. Directions so far out that the distortion polynomial
  // has folded back are projected without distortion, so that they never land inside the image.
  Vector2d project(const Vector3d& point_in_camera) const;
  // Ideal image-plane coordinates (x/z, y/z) of a raw pixel: the distortion is inverted by iteration, to < 1e-9.
  // Where no direction is seen at the pixel (beyond the fold), the direction that comes nearest.
  Vector2d normalized(const Vector2d& pixel) const;
  // Point in the camera frame seen at `pixel` with the given z, metres.
  Vector3d unproject(const Vector2d& pixel, double depth_m) const;
  // The same camera with its image resampled by `scale` (pixel centres stay at integers); sizes are rounded.
  Camera scaled(double scale) const;
  bool contains(const Vector2d& pixel) const {
    return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < width - 0.5 && pixel.y() < height - 0.5;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(width, height, fx, fy, cx, cy, distortion);
  }
};

// Ideal image-plane coordinates of every pixel, computed once: CV_64FC2, height x width, each `normalized({x, y})`.
cv::Mat normalized_grid(const Camera& camera);

// One Kinect: colour camera (absent for a bare depth scanner), infrared camera (its grid is the depth's), and the step
// between them. measured depth = true depth + depth_offset_m.
struct SensorCalibration {
  std::string model;  // "kinect_v2", ...
  std::optional<Camera> color;
  Camera ir;
  Isometry3d color_from_ir = Isometry3d::Identity();
  double depth_offset_m = 0;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(model, color, ir, color_from_ir, depth_offset_m);
  }
};

struct Calibration {
  std::map<std::string, SensorCalibration> sensors;  // by sensor name: "k1", ..., "handheld"

  template <class Archive>
  void serialize(Archive& archive) {
    archive(sensors);
  }
};

}  // namespace dressform
