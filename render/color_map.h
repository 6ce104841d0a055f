#pragma once
#include <opencv2/core/mat.hpp>

namespace dressform {

// The colours of Shading::scalar from minimum to maximum: viridis, equal steps in value look equally large.
// 256 x 1, 8-bit BGR.
cv::Mat scalar_colors();

// How a value without a number (NaN) is drawn: 8-bit grey level.
constexpr int kNoScalarGrey = 160;

}  // namespace dressform
