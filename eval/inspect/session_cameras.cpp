#include "eval/inspect/session_cameras.h"

#include "scenes/devices/device.h"

namespace dressform {

InspectedSensor inspected_sensor(const CaptureSession& session, const std::string& sensor, cv::Size depth_size) {
  if (session.calibration) {
    const auto found = session.calibration->sensors.find(sensor);
    if (found != session.calibration->sensors.end()) return {found->second, false};
  }
  InspectedSensor result;
  result.nominal = true;
  if (const SensorDevice* device = find_device(depth_size.width, depth_size.height)) {
    result.calibration.model = device->name;
    result.calibration.ir = device->ir_camera;
    return result;
  }
  const double focal_px = 0.75 * depth_size.width;  // about 67 degrees wide, between the two Kinects
  result.calibration.ir = Camera{depth_size.width,
                                 depth_size.height,
                                 focal_px,
                                 focal_px,
                                 0.5 * (depth_size.width - 1),
                                 0.5 * (depth_size.height - 1),
                                 {}};
  return result;
}

}  // namespace dressform
