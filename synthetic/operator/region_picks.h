#pragma once
#include <map>
#include <string>

#include "scenes/frame.h"
#include "scenes/picks.h"
#include "synthetic/operator/rim_picks.h"

namespace dressform {

// What the operator draws in the colour images of the dressed shots: outlines with corners that are missed by
// `click_px`. `label_<skin|top|bottom>_<sensor>`: what that is; `region_<slot>_<sensor>`: the garment's outline, across
// an arm that hides part of it; `smooth_<slot>_<sensor>`: the block of 31 x 31 pixels of most even colour that lies
// wholly inside the garment (thesis, section 3.2). `labels`: uint8, true, by sensor.
void draw_regions(const WornGarments& worn, const std::vector<SensorSpec>& rig,
                  const std::map<std::string, cv::Mat>& labels, const std::map<std::string, Shot>& shots,
                  double click_px, Seed seed, Picks& picks);

}  // namespace dressform
