#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "pipeline/body/body_landmarks.h"

namespace dressform {

// Directions round the upright axis of the hips, and heights over the floor: where a hem is drawn.
struct TrunkGrid {
  static constexpr int kColumns = 72;
  static constexpr double kRow_m = 0.005;

  explicit TrunkGrid(const Landmarks& limbs);

  int column(const cv::Vec3f& place) const;
  int row(const cv::Vec3f& place) const;
  // Metres above the curve, which gives every column its first row above.
  float above(const cv::Vec3f& place, const std::vector<int>& curve) const {
    return static_cast<float>(place[1] - floor_y - curve[column(place)] * kRow_m);
  }

  Vector3d axis = Vector3d::Zero();
  double floor_y = 0;
  int rows = 0;
};

}  // namespace dressform
