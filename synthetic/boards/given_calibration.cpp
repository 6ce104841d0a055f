#include "synthetic/boards/given_calibration.h"

#include <cmath>

#include "scenes/random.h"

namespace dressform {
namespace {

Camera off(Camera camera, const GivenCalibrationSpec& errors, Seed seed, std::uint64_t stream, int index) {
  const auto random = normal4(seed, stream, index);
  const double zoom = 1 + 0.01 * errors.focal_percent * random[0];
  camera.fx *= zoom;
  camera.fy *= zoom;
  camera.cx += errors.principal_px * random[1];
  camera.cy += errors.principal_px * random[2];
  if (!errors.distortion) camera.distortion = {0, 0, 0, 0, 0};
  return camera;
}

SensorCalibration off(SensorCalibration sensor, const GivenCalibrationSpec& errors, Seed seed, std::uint64_t stream) {
  const auto turn = normal4(seed, stream, 2), step = normal4(seed, stream, 3);
  sensor.ir = off(sensor.ir, errors, seed, stream, 0);
  sensor.depth_offset_m += 1e-3 * errors.depth_offset_mm * step[3];
  if (!sensor.color) return sensor;
  sensor.color = off(*sensor.color, errors, seed, stream, 1);
  const Vector3d axis(turn[0], turn[1], turn[2]);
  const double angle = errors.rotation_deg * M_PI / 180 * turn[3];
  sensor.color_from_ir.prerotate(Eigen::AngleAxisd(angle, axis.normalized()));
  sensor.color_from_ir.translation() += 1e-3 * errors.translation_mm * Vector3d(step[0], step[1], step[2]);
  return sensor;
}

}  // namespace

Calibration given_calibration(const Scene& scene, Seed seed) {
  const GivenCalibrationSpec& errors = scene.given_calibration;
  Calibration calibration;
  for (const auto& sensor : scene.rig)
    calibration.sensors[sensor.name] =
        errors.exact() ? sensor.calibration
                       : off(sensor.calibration, errors, seed, stream_of(("calibration " + sensor.name).c_str()));
  calibration.sensors["handheld"] = scene.scan.calibration;
  return calibration;
}

}  // namespace dressform
