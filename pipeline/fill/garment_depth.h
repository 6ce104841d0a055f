#pragma once
#include <opencv2/core/mat.hpp>

#include "pipeline/imaging/color_mapping.h"
#include "pipeline/segment/segment.h"

namespace dressform {

struct GarmentDepthParams {
  double edge_jump_mm = 30;   // pixels beside a larger step are dropped
  double ambiguous_px = 2.5;  // at 1920 x 1080: pixels with another label this near are dropped
};

// One dressed shot as the fill stage looks at it.
struct LabelledShot {
  cv::Mat depth_mm;  // float32, IR grid, offset removed
  cv::Mat label;     // uint8 on the IR grid: the label the pixel shows; 0 none or unknown
  cv::Mat certain;   // uint8 on the IR grid: 255 = no depth edge and no other label near
  ColorDepthMap map;
};
LabelledShot labelled_shot(const Shot& dressed, const SensorCalibration& sensor, const cv::Mat& labels,
                           const GarmentDepthParams& params);

// Depth of the pixels that surely show `label`: float32, IR grid, 0 = none.
cv::Mat garment_depth(const LabelledShot& shot, Label label);

}  // namespace dressform
