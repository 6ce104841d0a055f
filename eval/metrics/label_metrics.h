#pragma once
#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace dressform::metrics {

// Intersection over union of the pixels with this label; 1 where neither image has any. uint8 images of one size.
double label_iou(const cv::Mat& estimate, const cv::Mat& truth, std::uint8_t label);

// F of the label's outlines: outline pixels within `tolerance_px` of the other image's outline (Csurka et al., BMVC
// 2013). 1 where neither has an outline, 0 where one has none. An outline pixel has the label and a 4-neighbour that
// has not; the image's border is no outline.
double boundary_f(const cv::Mat& estimate, const cv::Mat& truth, std::uint8_t label, double tolerance_px = 2);

// Part of the estimated foreground (label above 0) that lies on the true background; 0 without any foreground.
double foreground_leakage(const cv::Mat& estimate, const cv::Mat& truth);
// Part of the true foreground that the estimate calls background; 0 without any foreground.
double foreground_miss(const cv::Mat& estimate, const cv::Mat& truth);

}  // namespace dressform::metrics
