#pragma once
#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "scenes/capture_session.h"

namespace dressform {

// A registered view as the outlier tests and the carving see it.
struct DepthView {
  int index = 0;  // in CaptureSession::sensors
  const SensorCalibration* sensor = nullptr;
  Isometry3d model_from_sensor = Isometry3d::Identity(), sensor_from_model = Isometry3d::Identity();
  cv::Mat depth_mm;  // float32, true depth of the dressed shot, 0 = none
  cv::Mat rays;      // pixel_rays of the IR camera
};
// The dressed views of the sensors whose pose is known (of the IR cameras), in the session's order.
std::vector<DepthView> depth_views(const CaptureSession& session, const Calibration& calibration,
                                   const std::map<std::string, Isometry3d>& model_from_sensor);

// How far in front of everything that the view sees around its pixel the point (model frame) lies, metres; negative
// behind; NaN where the view has no depth for all of the 3 x 3 pixels or does not cover the point.
double free_space_violation_m(const DepthView& view, const Vector3d& point);

}  // namespace dressform
