#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "pipeline/segment/view_evidence.h"

namespace dressform {

struct TopBottomParams {
  double color_nats = 3;      // most that the colour of one pixel may say
  double row_price = 1;       // of the curve between top and bottom, nats per 5 mm of change between directions
  double band_mm = 45;        // round the curve, in which colour decides pixel by pixel
  double smoothness = 8;      // of the cut, nats
  double speck_mm2 = 500;     // smaller pieces join what surrounds them
  double least_mm2 = 6000;    // of cloth on chest or legs, below which there is no such garment
  double least_nats = 0.5;    // that colour says beside a hem, on average
  double least_share = 0.72;  // of the pixels beside a hem whose colour tells their side
  int rounds = 3;             // of learning colours and tracing the curve
};

struct TopBottom {
  std::vector<cv::Mat> top, bottom;  // uint8 at the size of each view's crop
  bool has_top = false, has_bottom = false;
};

// Parts cloth (uint8 masks by view) into upper and lower garment. Cloth on chest and upper arms is top; a closed curve
// round the body is traced in all views together by the colours of both, and redrawn by a minimum cut in each image.
// Where no curve parts colours that differ the cloth is one garment, unless it goes round each leg: then the curve runs
// where the top's edge shows.
TopBottom part_cloth(const std::vector<ViewEvidence>& views, const std::vector<cv::Mat>& cloth, const Landmarks& limbs,
                     const TopBottomParams& params);

}  // namespace dressform
