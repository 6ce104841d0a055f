#pragma once
#include <opencv2/core/mat.hpp>

#include "pipeline/segment/view_evidence.h"

namespace dressform {

struct SkinColoredClothParams {
  double island_mm2 = 3000;  // larger enclosed pieces of skin on trunk and legs are believed
  double raised_mm = 2.5;    // pieces of skin whose median offset is more are cloth
  double speck_mm2 = 500;    // smaller parts of a piece are believed
};

// Adds to the cloth of one view what was taken for skin because it has the skin's colour: pieces that cloth encloses,
// and pieces and parts of pieces that stand off the naked body, which many pixels tell together where one cannot.
// `cloth`: uint8 at the size of the crop, 255 = cloth.
void add_skin_colored_cloth(const ViewEvidence& view, const SkinColoredClothParams& params, cv::Mat& cloth);

}  // namespace dressform
