#include "eval/inspect/session_cameras.h"

#include "synthetic/sensors/noise_statistics.h"

namespace dressform {

InspectedSensor inspected_sensor(const CaptureSession& session, const std::string& sensor, cv::Size depth_size) {
  if (session.calibration) {
    const auto found = session.calibration->sensors.find(sensor);
    if (found != session.calibration->sensors.end()) return {found->second, false};
  }
  InspectedSensor result;
  result.nominal = true;
  for (const char* model : {"kinect_v2", "kinect_v1"}) {
    const Camera camera = usual_camera(model);
    if (camera.width != depth_size.width || camera.height != depth_size.height) continue;
    result.calibration.model = model;
    result.calibration.ir = camera;
    return result;
  }
  const double focal_px = 0.75 * depth_size.width;
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
