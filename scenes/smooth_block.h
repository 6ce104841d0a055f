#pragma once
#include <opencv2/core/mat.hpp>

namespace dressform {

// The square of `size_px` pixels of the most even brightness (least variance of the grey image) among those that lie
// wholly inside `mask` (uint8, 255 inside, of the size of `bgr`); the first of equals by rows. Empty: none fits.
// Thesis, section 3.2.2.
cv::Rect smoothest_block(const cv::Mat& bgr, const cv::Mat& mask, int size_px);

}  // namespace dressform
