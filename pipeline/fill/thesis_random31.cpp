#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "pipeline/fill/fill_views.h"
#include "scenes/random.h"

namespace dressform {
namespace {

struct ThesisRandomParams {
  GarmentDepthParams depth;
  HoleParams holes;
  int block_px = 31;
};
template <class V>
void fields(V& v, ThesisRandomParams& p) {
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

// Each filled pixel takes the colour of a random pixel of the smoothest block (thesis, section 3.4.2); the block
// shrinks until one fits.
cv::Mat paint(const std::vector<GarmentView>& views, std::size_t index, int block_px, Seed seed) {
  const FilledGarment& garment = views[index].garment;
  cv::Mat color = garment.color.clone();
  const cv::Mat inside = garment.mask == 255;
  int size = block_px;
  cv::Point block(-1, -1);
  for (; size >= 1 && block.x<0; size = size> 1 ? (size + 1) / 2 : 0) {
    block = smoothest_block(color, inside, size);
    if (block.x >= 0) break;
  }
  if (block.x < 0) return color;
  const std::uint64_t stream =
      stream_of("fill.thesis_random31") + 16 * index + static_cast<std::uint64_t>(views[index].label);
  for (int y = 0; y < color.rows; ++y) {
    for (int x = 0; x < color.cols; ++x) {
      if (garment.mask.at<uchar>(y, x) != 128) continue;
      const auto random = uniform4(seed, stream, static_cast<std::uint64_t>(y) * color.cols + x);
      const int dx = std::min(size - 1, static_cast<int>(random[0] * size));
      const int dy = std::min(size - 1, static_cast<int>(random[1] * size));
      color.at<cv::Vec3b>(y, x) = garment.color.at<cv::Vec3b>(block.y + dy, block.x + dx);
    }
  }
  return color;
}

FilledViews thesis_random31(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                            const Registration& registration, const Segmentation& segmentation,
                            const ThesisRandomParams& params, Seed seed) {
  return fill_views(
      session, calibration, naked, registration, segmentation, params.depth, params.holes,
      [&](const std::vector<GarmentView>& views, std::size_t k) { return paint(views, k, params.block_px, seed); });
}

const Fill::Variant thesis_random31_variant{"thesis_random31", thesis_random31};

}  // namespace
}  // namespace dressform
