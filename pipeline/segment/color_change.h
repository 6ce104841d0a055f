#pragma once
#include <opencv2/core/mat.hpp>

namespace dressform {

// Change, in units of the noise, that a place which merely lies in shadow counts as: neither unchanged nor changed.
extern const float kShadowUnits;

struct ColorChange {
  cv::Mat units;          // float32, size of the box: change in units of the noise
  cv::Mat shadow;         // uint8: 255 where the dressed shot shows the naked one's colour in shadow
  cv::Mat matched_naked;  // 8-bit BGR, size of the box: the naked shot at the dressed shot's exposure
};

// How the colours of two shots of one fixed camera differ inside `box`. Exposure (a gain per channel) and noise are
// estimated where neither shot shows the mannequin: `body` (uint8, full size) != 0 is left out.
ColorChange color_change(const cv::Mat& dressed_bgr, const cv::Mat& naked_bgr, const cv::Mat& body,
                         const cv::Rect& box);

}  // namespace dressform
