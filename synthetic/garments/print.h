#pragma once
#include <opencv2/core/mat.hpp>

#include "scenes/registry.h"
#include "scenes/scene.h"

namespace dressform {

// Printed cloth as an albedo image (8-bit BGR, sRGB). Metric: `width_m` x `height_m` of cloth are painted on
// `pixels_per_m`; the front centre of the garment is at the centre of the image.
cv::Mat paint_print(const PrintSpec& spec, double width_m, double height_m, double pixels_per_m, Seed seed);

}  // namespace dressform
