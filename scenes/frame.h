#pragma once
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenes/camera.h"

namespace dressform {

// The Kinect SDK's skeleton: metres, IR camera frame.
struct Joint {
  Vector3d position = Vector3d::Zero();
  bool tracked = false;
};
using Skeleton = std::map<std::string, Joint>;  // by the SDK's 25 names
const std::vector<std::string>& joint_names();

// One shot of one sensor. Raw images: nothing is undistorted.
struct Shot {
  cv::Mat color;       // 8-bit BGR, sRGB; empty for a bare depth scanner
  cv::Mat depth_mm;    // uint16, along the IR camera's axis, 0 = none, on the IR grid
  cv::Mat ir;          // uint16, on the IR grid; empty when not recorded
  cv::Mat body_index;  // uint8, 255 = none, on the IR grid; empty when not recorded
  std::optional<Skeleton> skeleton;
};

// A hand-held sensor walking round a body: depth frames in order.
struct DepthScan {
  std::string sensor;             // its calibration's name
  std::vector<cv::Mat> depth_mm;  // uint16, as in Shot
  // As the recorder knew them (motion capture, its own tracking): one for each frame, NaNs where it did not; empty: not
  // recorded. Any world; metres.
  std::vector<Isometry3d> world_from_frame = {};
};

}  // namespace dressform
