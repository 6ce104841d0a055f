#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "pipeline/segment/view_evidence.h"

namespace dressform {

struct ClothParams {
  double skin_sigma_mm = 4;  // of the offset of bare skin, after smoothing, what bounced light leaves included
  double shape_nats = 4;     // most that the offset of one pixel may say
  double change_nats = 3;    // most that the colour change of one pixel may say
  double color_nats = 3;     // most that the colour of one pixel may say
  double smoothness = 8;     // of the cut, nats
  double speck_mm2 = 500;    // smaller pieces of skin or cloth are turned over
  double island_mm2 = 3000;  // larger enclosed pieces of skin on trunk and legs are believed
  double raised_mm = 2.5;    // pieces of skin whose median offset is more are cloth of the skin's colour
  int rounds = 2;            // of learning colours and cutting
};

// Cloth or skin: uint8 at the size of each view's crop, 255 = cloth, 0 = skin or nothing. Three cues per pixel (offset
// from the naked body, change against the naked shot, colour models of skin and cloth) and a minimum cut per view.
std::vector<cv::Mat> find_cloth(const std::vector<ViewEvidence>& views, const ClothParams& params);

}  // namespace dressform
