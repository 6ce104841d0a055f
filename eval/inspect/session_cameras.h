#pragma once
#include "scenes/capture_session.h"

namespace dressform {

// The calibration of a sensor; where the session has none (boards are to give it) the usual camera of such an image
// size, `nominal`: good enough to look at.
struct InspectedSensor {
  SensorCalibration calibration;
  bool nominal = false;
};
InspectedSensor inspected_sensor(const CaptureSession& session, const std::string& sensor, cv::Size depth_size);

}  // namespace dressform
