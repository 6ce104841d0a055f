#pragma once
#include <opencv2/core/mat.hpp>

namespace dressform {

// Standard deviation of the noise of one channel, in levels, around a brightness (0-255), found in the smoothest blocks
// of the whole photograph: walls and floors tell noise from the weave of cloth. 8-bit BGR. From the response to a
// second difference that neither shading nor straight edges answer to (Immerkaer, CVIU 1996). 0 for images without
// blocks.
double noise_levels(const cv::Mat& color, double level);

}  // namespace dressform
