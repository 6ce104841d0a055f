#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "pipeline/fill/random_paint.h"

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

// Top left corner of the block of even colour that lies wholly inside `inside`; x < 0 when none fits.
cv::Point smoothest_block(const cv::Mat& bgr, const cv::Mat& inside, int size) {
  cv::Mat grey, sum, squares, count;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  cv::integral(grey, sum, squares, CV_64F, CV_64F);
  cv::integral(inside / 255, count, CV_32S);
  const auto total = [size](const cv::Mat& table, int x, int y, auto type) {
    using T = decltype(type);
    return static_cast<double>(table.at<T>(y + size, x + size) - table.at<T>(y, x + size) - table.at<T>(y + size, x) +
                               table.at<T>(y, x));
  };
  cv::Point best(-1, -1);
  double least = 1e300;
  const double pixels = static_cast<double>(size) * size;
  for (int y = 0; y + size <= grey.rows; ++y) {
    for (int x = 0; x + size <= grey.cols; ++x) {
      if (total(count, x, y, int{}) < pixels) continue;
      const double mean = total(sum, x, y, double{}) / pixels;
      const double variance = total(squares, x, y, double{}) / pixels - mean * mean;
      if (variance >= least) continue;
      least = variance;
      best = {x, y};
    }
  }
  return best;
}

// From the smoothest block; it shrinks until one fits.
cv::Mat paint(const std::vector<GarmentView>& views, std::size_t index, int block_px, Seed seed) {
  const FilledGarment& garment = views[index].garment;
  const cv::Mat inside = garment.mask == 255;
  int size = block_px;
  cv::Point block(-1, -1);
  for (; size >= 1 && block.x<0; size = size> 1 ? (size + 1) / 2 : 0) {
    block = smoothest_block(garment.color, inside, size);
    if (block.x >= 0) break;
  }
  if (block.x < 0) return garment.color.clone();
  cv::Mat lends = cv::Mat::zeros(inside.size(), CV_8U);
  lends(cv::Rect(block, cv::Size(size, size))) = 255;
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
