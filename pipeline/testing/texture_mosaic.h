#pragma once
#include <opencv2/core/mat.hpp>

#include "scenes/registry.h"

namespace dressform::testing_images {

// For tests only: an image of several textures that meet along curved borders, and which pixel is of which.
struct TextureMosaic {
  cv::Mat bgr;      // 8-bit
  cv::Mat regions;  // int32, 1 to the number of textures
};

// Stripes, checks, dots, speckle and plain colours in turn, of random colours, periods and directions, with the noise
// of a camera. Cells of scattered points, their coordinates bent.
TextureMosaic texture_mosaic(Seed seed, int textures, const cv::Size& size = {320, 320});

// F measure of the borders between regions (int32), both ways within `tolerance_px`: 1 where they agree.
double boundary_f(const cv::Mat& found, const cv::Mat& truth, double tolerance_px);

}  // namespace dressform::testing_images
