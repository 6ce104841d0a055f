#pragma once
#include <functional>

#include "pipeline/fill/fill.h"

namespace dressform {

// Gives colours to what is unknown (uint8, not 0) of an 8-bit BGR image; returns an image of the same size.
using Inpaint = std::function<cv::Mat(const cv::Mat& bgr, const cv::Mat& unknown)>;

// `bgr` with `hole` (uint8, not 0) inpainted on a crop `margin_px` round it, from pixels of `inside` (uint8) alone: not
// from the arm beside the hole, nor from the room behind the garment. Unchanged where nothing of `inside` is near.
cv::Mat inpainted_from(const cv::Mat& bgr, const cv::Mat& hole, const cv::Mat& inside, int margin_px,
                       const Inpaint& inpaint);

// Pixels well inside what is seen of the garment (uint8): those at its edge mix with what is beside it.
cv::Mat well_inside(const FilledGarment& garment);

}  // namespace dressform
