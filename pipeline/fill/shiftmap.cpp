#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/photo.hpp>
#include <opencv2/xphoto/inpainting.hpp>

#include "pipeline/fill/fill_views.h"
#include "pipeline/fill/garment_inpaint.h"
#include "pipeline/imaging/seeded_rng.h"

namespace dressform {
namespace {

struct ShiftmapParams {
  GarmentDepthParams depth;
  HoleParams holes;
  double surround = 1;
  int most_px = 20000;
};
template <class V>
void fields(V& v, ShiftmapParams& p) {
  shared_fields(v, p.depth, p.holes);
  v("surround", p.surround, 0.2, 4, "", "cloth round the hole that may be shifted into it, in widths of the hole");
  v("most_px", p.most_px, 200, 1000000, "px", "of the unknown: a larger hole is filled at a lower resolution");
}

constexpr int kLeastSurround_px = 24;  // patches are 8 wide, and shifts of less than two patches are not looked at
constexpr double kRestRadius_px = 3;   // of the inpainting of what no shift reaches

// Shifts are found in Lab, as the library asks. Pixels that no shift takes to the garment stay black there, with a and
// b zero, which no colour has.
cv::Mat shifted_in(const cv::Mat& bgr, const cv::Mat& unknown) {
  cv::Mat lab, filled, result, inpainted;
  cv::cvtColor(bgr, lab, cv::COLOR_BGR2Lab);
  cv::xphoto::inpaint(lab, unknown == 0, filled, cv::xphoto::INPAINT_SHIFTMAP);
  cv::Mat left;
  cv::inRange(filled, cv::Scalar(0, 0, 0), cv::Scalar(0, 0, 0), left);
  cv::cvtColor(filled, result, cv::COLOR_Lab2BGR);
  left &= unknown;
  if (cv::countNonZero(left) == 0) return result;
  cv::inpaint(result, left, inpainted, kRestRadius_px, cv::INPAINT_TELEA);
  return inpainted;
}

cv::Mat shifted_in_at_most(const cv::Mat& bgr, const cv::Mat& unknown, int most_px) {
  const double scale = std::sqrt(most_px / std::max(1.0, static_cast<double>(cv::countNonZero(unknown))));
  if (scale >= 1) return shifted_in(bgr, unknown);
  const cv::Size size(std::max(1, cvRound(scale * bgr.cols)), std::max(1, cvRound(scale * bgr.rows)));
  cv::Mat small, small_unknown, result;
  cv::resize(bgr, small, size, 0, 0, cv::INTER_AREA);
  cv::resize(unknown, small_unknown, size, 0, 0, cv::INTER_AREA);
  if (cv::countNonZero(small_unknown == 0) == 0) return bgr.clone();
  cv::resize(shifted_in(small, small_unknown > 0), result, bgr.size(), 0, 0, cv::INTER_LINEAR);
  return result;
}

// Pieces of the garment's own photograph shifted into the hole, by the shifts that most patches of it repeat at, joined
// where they differ least (Pritch, Kav-Venaki and Peleg, "Shift-map image editing", ICCV 2009; He and Sun, "Statistics
// of patch offsets for image completion", ECCV 2012), by OpenCV's xphoto. Depth and holes as in all variants; only
// pixels of the garment are shifted.
FilledViews shiftmap(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                     const Registration& registration, const Segmentation& segmentation, const ShiftmapParams& params,
                     Seed seed) {
  const auto inpaint = [&](const cv::Mat& bgr, const cv::Mat& unknown) {
    const SeededRng seeded(seed);
    return shifted_in_at_most(bgr, unknown, params.most_px);
  };
  return fill_views(session, calibration, naked, registration, segmentation, params.depth, params.holes,
                    [&](const std::vector<GarmentView>& views, std::size_t k) {
                      const FilledGarment& garment = views[k].garment;
                      const cv::Mat hole = garment.mask == 128;
                      const cv::Rect box = cv::boundingRect(hole);
                      const int margin =
                          std::max(kLeastSurround_px, cvRound(params.surround * std::min(box.width, box.height)));
                      return inpainted_from(garment.color, hole, well_inside(garment), margin, inpaint);
                    });
}

const Fill::Variant shiftmap_variant{"shiftmap", shiftmap};

}  // namespace
}  // namespace dressform
