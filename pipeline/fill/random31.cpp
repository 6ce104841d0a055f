#include <algorithm>

#include "pipeline/fill/random_paint.h"
#include "scenes/smooth_block.h"

namespace dressform {
namespace {

struct RandomParams {
  GarmentDepthParams depth;
  HoleParams holes;
  int block_px = 31;
};
template <class V>
void fields(V& v, RandomParams& p) {
  shared_fields(v, p.depth, p.holes);
  v("block_px", p.block_px, 3, 201, "px", "edge of the smooth block of cloth that lends its colours");
}

// From the smoothest block; it shrinks until one fits.
cv::Mat paint(const std::vector<GarmentView>& views, std::size_t index, int block_px, Seed seed) {
  const FilledGarment& garment = views[index].garment;
  const cv::Mat inside = garment.mask == 255;
  cv::Rect block;
  for (int size = block_px; size >= 1 && block.empty(); size = size > 1 ? (size + 1) / 2 : 0)
    block = smoothest_block(garment.color, inside, size);
  if (block.empty()) return garment.color.clone();
  cv::Mat lends = cv::Mat::zeros(inside.size(), CV_8U);
  lends(block) = 255;
  return painted_at_random(garment, lends, paint_stream(views, index), seed);
}

// Each filled pixel takes the colour of a random pixel of the smoothest block, as in the thesis (section 3.2.2), but
// block and region are found here: thesis_random31 takes those that a person picked.
FilledViews random31(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                     const Registration& registration, const Segmentation& segmentation, const RandomParams& params,
                     Seed seed) {
  return fill_views(
      session, calibration, naked, registration, segmentation, params.depth, params.holes,
      [&](const std::vector<GarmentView>& views, std::size_t k) { return paint(views, k, params.block_px, seed); });
}

const Fill::Variant random31_variant{"random31", random31};

}  // namespace
}  // namespace dressform
