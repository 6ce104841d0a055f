#pragma once
#include <opencv2/core/mat.hpp>

#include "scenes/registry.h"

namespace dressform {

// Gaussian noise of unit deviation, float32, smooth over so many pixels across and down.
cv::Mat smooth_noise(const cv::Size& size, double across_px, double down_px, Seed seed, std::uint64_t stream);

// An 8-bit BGR print as the weave shows it: yarns of uneven thickness both ways and a slow unevenness of the dye.
// Contrasts: deviations of the brightness.
cv::Mat woven(const cv::Mat& print, double pixels_per_m, double yarn_contrast, double dye_contrast, Seed seed);

}  // namespace dressform
