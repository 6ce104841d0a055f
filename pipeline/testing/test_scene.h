#pragma once
// An analytic figure of ellipsoids on a floor between walls, for tests and benchmarks: exact depth images.
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <vector>

#include "pipeline/imaging/sensor_noise.h"
#include "scenes/camera.h"
#include "scenes/frame.h"
#include "scenes/mesh.h"
#include "scenes/random.h"

namespace dressform::test_scene {

struct Ellipsoid {
  Vector3d centre;
  Vector3d radii;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
};

struct Figure {
  std::vector<Ellipsoid> parts;
  double wall_m = 2.6;  // half the room's edge; 0: no walls
  bool floor = true;
};

// A standing figure, world frame: y up, floor y = 0, facing +z, 1.8 m tall. Parts overlap.
inline Figure standing_figure() {
  const auto tilt = [](double degrees) {
    return Eigen::AngleAxisd(degrees * M_PI / 180, Vector3d::UnitZ()).toRotationMatrix();
  };
  Figure figure;
  figure.parts = {{{0, 1.20, 0}, {.18, .34, .12}, {}},      {{0, 0.95, -.01}, {.17, .17, .13}, {}},
                  {{0, 1.30, .06}, {.14, .12, .08}, {}},    {{0, 1.52, .01}, {.06, .12, .06}, {}},
                  {{0, 1.67, .02}, {.075, .125, .095}, {}}, {{0, 1.66, .115}, {.015, .03, .02}, {}},
                  {{.10, .48, 0}, {.075, .48, .08}, {}},    {{-.10, .48, 0}, {.075, .48, .08}, {}},
                  {{.10, .04, .07}, {.045, .04, .13}, {}},  {{-.10, .04, .07}, {.045, .04, .13}, {}},
                  {{.27, 1.14, 0}, {.05, .34, .055}, {}},   {{-.27, 1.14, 0}, {.05, .34, .055}, {}},
                  {{.36, .82, .02}, {.025, .09, .04}, {}},  {{-.36, .82, .02}, {.025, .09, .04}, {}}};
  for (auto& part : figure.parts) part.rotation = Eigen::Matrix3d::Identity();
  for (const int i : {10, 12}) figure.parts[i].rotation = tilt(16);
  for (const int i : {11, 13}) figure.parts[i].rotation = tilt(-16);
  return figure;
}

struct Hit {
  double distance = std::numeric_limits<double>::infinity();  // in units of the direction's length
  Vector3d normal = Vector3d::Zero();
  bool body = false;
};

inline Hit cast(const Figure& figure, const Vector3d& origin, const Vector3d& direction) {
  Hit best;
  for (const auto& part : figure.parts) {
    const Vector3d o = (part.rotation.transpose() * (origin - part.centre)).cwiseQuotient(part.radii);
    const Vector3d d = (part.rotation.transpose() * direction).cwiseQuotient(part.radii);
    const double a = d.squaredNorm(), b = o.dot(d), c = o.squaredNorm() - 1, root = b * b - a * c;
    if (root <= 0) continue;
    const double t = (-b - std::sqrt(root)) / a;
    if (t <= 0 || t >= best.distance) continue;
    const Vector3d normal = part.rotation * (o + t * d).cwiseQuotient(part.radii);
    best = {t, normal.normalized(), true};
  }
  const auto plane = [&](const Vector3d& normal, double offset) {  // normal.p = offset, seen from the normal's side
    const double slope = normal.dot(direction);
    if (slope >= 0) return;
    const double t = (offset - normal.dot(origin)) / slope;
    if (t > 0 && t < best.distance) best = {t, normal, false};
  };
  if (figure.floor) plane(Vector3d::UnitY(), 0);
  if (figure.wall_m > 0)
    for (const int axis : {0, 2})
      for (const double sign : {1.0, -1.0}) plane(sign * Vector3d::Unit(axis), -figure.wall_m);
  return best;
}

// Distance of a point to the figure's surface, to first order (exact on the surface), metres, positive outside.
inline double distance_to(const Figure& figure, const Vector3d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& part : figure.parts) {
    const Vector3d p = part.rotation.transpose() * (point - part.centre);
    const Vector3d q = p.cwiseQuotient(part.radii), g = q.cwiseQuotient(part.radii);
    const double value = q.norm();
    const double gradient = std::max(g.norm() / std::max(value, 1e-9), 1e-9);
    nearest = std::min(nearest, (value - 1) / gradient);
  }
  return nearest;
}

inline SensorCalibration kinect(double scale, double depth_offset_m = 0) {
  SensorCalibration calibration;
  calibration.model = "kinect_v2";
  calibration.ir = Camera{512, 424, 366.95, 364.79, 252.99, 207.70, {.0966, -.2830, .00016, -.00051, .1052}};
  calibration.ir = calibration.ir.scaled(scale);
  calibration.depth_offset_m = depth_offset_m;
  return calibration;
}

// World-from-sensor of a sensor that looks at `target` from `eye`, upright up to a roll.
inline Isometry3d looking_at(const Vector3d& eye, const Vector3d& target, double roll_deg = 0) {
  Isometry3d pose = Isometry3d::Identity();
  const Vector3d z = (target - eye).normalized(), x = z.cross(Vector3d::UnitY()).normalized();
  pose.linear() << x, z.cross(x), z;
  pose.translation() = eye;
  return pose * Eigen::AngleAxisd(roll_deg * M_PI / 180, Vector3d::UnitZ());
}

// Depth image with the noise of the sensor times `noise`; millimetres.
inline cv::Mat depth_image(const Figure& figure, const SensorCalibration& calibration, const cv::Mat& rays,
                           const Isometry3d& world_from_sensor, double noise, std::uint64_t seed) {
  cv::Mat image(calibration.ir.height, calibration.ir.width, CV_16U, cv::Scalar(0));
  const auto read = [&](double u, double v) {  // bilinear: neighbouring rays differ little
    const int x = std::clamp(static_cast<int>(std::floor(u)), 0, rays.cols - 2);
    const int y = std::clamp(static_cast<int>(std::floor(v)), 0, rays.rows - 2);
    const double a = u - x, b = v - y;
    return rays.at<cv::Vec2d>(y, x) * (1 - a) * (1 - b) + rays.at<cv::Vec2d>(y, x + 1) * a * (1 - b) +
           rays.at<cv::Vec2d>(y + 1, x) * (1 - a) * b + rays.at<cv::Vec2d>(y + 1, x + 1) * a * b;
  };
  const auto z_at = [&](double u, double v, double& cosine) {
    const cv::Vec2d ray = read(u, v);
    const Vector3d local(ray[0], ray[1], 1), direction = world_from_sensor.linear() * local;
    const Hit hit = cast(figure, world_from_sensor.translation(), direction);
    cosine = std::abs(hit.normal.dot(direction)) / direction.norm();
    return hit.distance;
  };
  tbb::parallel_for(0, image.rows, [&](int y) {
    for (int x = 0; x < image.cols; ++x) {
      double cosine = 1, unused = 1;
      double z = z_at(x, y, cosine);
      if (noise > 0) {  // flying pixels: the mean of two rays in one pixel
        const double other = z_at(x + 0.4, y + 0.3, unused);
        if (std::isfinite(other) && std::isfinite(z) && std::abs(other - z) > 0.03) z = (z + other) / 2;
        z += noise * axial_noise_m(z, cosine) * normal4(seed, 1, static_cast<std::uint64_t>(y) * image.cols + x)[0];
      }
      z += calibration.depth_offset_m;
      if (z > 0.5 && z < 4.5) image.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(std::lround(1000 * z));
    }
  });
  return image;
}

struct Scan {
  DepthScan scan;
  std::vector<Isometry3d> world_from_sensor;
};

// A walk round the figure by `turn_deg`, with jitter.
inline Scan walk_round(const Figure& figure, const SensorCalibration& calibration, int frames, double turn_deg,
                       double noise, std::uint64_t seed) {
  const cv::Mat rays = normalized_grid(calibration.ir);
  Scan result;
  result.scan.sensor = "handheld";
  for (int i = 0; i < frames; ++i) {
    const auto jitter = normal4(seed, 2, i), more = normal4(seed, 3, i);
    const double angle = turn_deg * M_PI / 180 * i / (frames - 1) + 0.3;
    const Vector3d eye(1.9 * std::sin(angle) + .015 * jitter[0], 1.15 + .02 * jitter[1],
                       1.9 * std::cos(angle) + .015 * jitter[2]);
    const Vector3d target(.02 * jitter[3], 0.95 + .02 * more[0], .02 * more[1]);
    result.world_from_sensor.push_back(looking_at(eye, target, 0.8 * more[2]));
    result.scan.depth_mm.push_back(
        depth_image(figure, calibration, rays, result.world_from_sensor.back(), noise, seed * 1000 + i));
  }
  return result;
}

}  // namespace dressform::test_scene
