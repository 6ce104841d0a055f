#pragma once
#include <optional>

#include "scenes/camera.h"

namespace dressform::metrics {

struct CameraErrors {
  double focal_percent = 0;  // the larger of |fx / true - 1| and |fy / true - 1|
  double principal_px = 0;   // distance of the principal points
};
CameraErrors camera_errors(const Camera& estimate, const Camera& truth);

struct SensorErrors {
  CameraErrors ir;
  std::optional<CameraErrors> color;  // where both have a colour camera
  double color_from_ir_deg = 0, color_from_ir_mm = 0;
  double depth_offset_mm = 0;  // absolute
  double point_mm = 0;         // root mean square distance of the points that a true depth of 2.1 m gives, all pixels
  double mapping_px = 0;       // the same of the colour pixels that those points are given
};
SensorErrors sensor_errors(const SensorCalibration& estimate, const SensorCalibration& truth);

}  // namespace dressform::metrics
