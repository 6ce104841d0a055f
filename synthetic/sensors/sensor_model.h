#pragma once
#include <opencv2/core/mat.hpp>

#include "scenes/registry.h"
#include "synthetic/capture/ir_view.h"

namespace dressform {

// What a depth sensor delivers for one view.
struct SensorFrame {
  cv::Mat depth_mm;  // uint16, along the optical axis, 0 = none; measured = true + depth offset
  cv::Mat ir;        // uint16; may be empty where the view wants none
};

// A depth sensor: turns what its infrared camera stands before into what it measures. Variants: sensors/<model>.cpp.
// The view gives first hits per pixel and a ray service for subsamples.
struct SensorModelTag {
  static constexpr const char* name = "sensor";
  static constexpr const char* default_variant = "kinect_v2";
};
using SensorModel = Registry<SensorModelTag, SensorFrame(const IrView&)>;

// Infrared value of a surface: 16 x 1300 counts for a white one facing the camera at 1 m, falling with 1/r^2 and the
// cosine; chrome is dark but for the glint, which saturates.
float ir_counts(const IrSample& sample, float cos_axis);

// uint16 depth of a true one: offset added, rounded to millimetres, 0 outside [minimum, maximum].
std::uint16_t depth_in_mm(double depth_m, double offset_m, double minimum_m, double maximum_m);

}  // namespace dressform
