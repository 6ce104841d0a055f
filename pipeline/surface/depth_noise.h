#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

namespace dressform {

// Sigma of the noise of depth images, millimetres, from themselves: a robust spread of third differences along rows and
// along columns, whichever is less, so that neither slope nor the even bend of a limb counts. `images`: float32,
// millimetres, 0 = none. Pixels are taken far enough apart that the driver's filter does not tie them together.
// 0 where there is too little to tell.
double depth_noise_mm(const std::vector<cv::Mat>& images, double jump_mm);

}  // namespace dressform
