#pragma once
#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>

namespace dressform {

// What is known of the place of the mannequin in one view, and of its size.
struct BodyExpectation {
  Eigen::Vector3d up = Eigen::Vector3d(0, -1, 0);  // sensor frame, unit
  std::optional<Eigen::Vector4d> floor;            // (n, d), n pointing up
  std::optional<Eigen::Vector3d> place;            // sensor frame, metres: near the body's axis, from the rig prior
  double place_sigma_m = 0.4;
  double stature_m = 1.8;
};

struct BodyRegionParams {
  double jump_mm = 30;    // depth difference that parts two pixels
  double radius_m = 0.7;  // of the upright cylinder round the body's axis that holds body and clothes
  double floor_margin_m = 0.025;
};

struct BodyRegion {
  cv::Mat mask;  // uint8 on the IR grid: 255 = body
  bool found = false;
};

// The connected pieces of the depth image that make up one standing body. body_index (uint8, 255 = none) may be empty:
// it only helps to choose. points_m: float32 x 3, sensor frame.
BodyRegion find_body(const cv::Mat& depth_mm, const cv::Mat& points_m, const cv::Mat& body_index,
                     const BodyExpectation& expected, const BodyRegionParams& params);

}  // namespace dressform
