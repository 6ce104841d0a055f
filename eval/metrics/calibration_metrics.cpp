#include "eval/metrics/calibration_metrics.h"

#include <algorithm>
#include <cmath>

#include "eval/metrics/registration_metrics.h"

namespace dressform::metrics {
namespace {

constexpr double working_distance_m = 2.1;
constexpr int grid_steps = 24;  // over width and height of the infrared image

}  // namespace

CameraErrors camera_errors(const Camera& estimate, const Camera& truth) {
  CameraErrors errors;
  errors.focal_percent = 100 * std::max(std::abs(estimate.fx / truth.fx - 1), std::abs(estimate.fy / truth.fy - 1));
  errors.principal_px = std::hypot(estimate.cx - truth.cx, estimate.cy - truth.cy);
  return errors;
}

SensorErrors sensor_errors(const SensorCalibration& estimate, const SensorCalibration& truth) {
  SensorErrors errors;
  errors.ir = camera_errors(estimate.ir, truth.ir);
  errors.depth_offset_mm = 1000 * std::abs(estimate.depth_offset_m - truth.depth_offset_m);
  const bool both = estimate.color && truth.color;
  if (both) {
    errors.color = camera_errors(*estimate.color, *truth.color);
    errors.color_from_ir_deg = rotation_error_deg(estimate.color_from_ir, truth.color_from_ir);
    errors.color_from_ir_mm = 1000 * (estimate.color_from_ir.translation() - truth.color_from_ir.translation()).norm();
  }
  double points = 0, pixels = 0;
  int mapped = 0;
  for (int row = 0; row <= grid_steps; ++row)
    for (int column = 0; column <= grid_steps; ++column) {
      const Vector2d pixel(column * (truth.ir.width - 1.0) / grid_steps, row * (truth.ir.height - 1.0) / grid_steps);
      const double measured_m = working_distance_m + truth.depth_offset_m;
      const Vector3d true_point = truth.ir.unproject(pixel, working_distance_m);
      const Vector3d point = estimate.ir.unproject(pixel, measured_m - estimate.depth_offset_m);
      points += (point - true_point).squaredNorm();
      if (!both) continue;
      const Vector2d true_pixel = truth.color->project(truth.color_from_ir * true_point);
      if (!truth.color->contains(true_pixel)) continue;
      pixels += (estimate.color->project(estimate.color_from_ir * point) - true_pixel).squaredNorm();
      ++mapped;
    }
  errors.point_mm = 1000 * std::sqrt(points / ((grid_steps + 1) * (grid_steps + 1)));
  errors.mapping_px = mapped ? std::sqrt(pixels / mapped) : std::nan("");
  return errors;
}

}  // namespace dressform::metrics
