#include <opencv2/photo.hpp>

#include "pipeline/fill/fill_views.h"
#include "pipeline/fill/garment_inpaint.h"

namespace dressform {
namespace {

struct TeleaParams {
  GarmentDepthParams depth;
  HoleParams holes;
  double radius_px = 3;
};
template <class V>
void fields(V& v, TeleaParams& p) {
  shared_fields(v, p.depth, p.holes);
  v("radius_px", p.radius_px, 1, 30, "px",
    "of the neighbourhood that each pixel takes its colour from; 3 is the usual one");
}

constexpr int kTeleaMargin_px = 12;  // round the hole: more than any usual radius

// The photograph's own colours carried on into the hole, pixel by pixel from its edge inwards (Telea, "An image
// inpainting technique based on the fast marching method", Journal of Graphics Tools 2004), by OpenCV. Depth and holes
// as in all variants; only pixels of the garment lend colours, as who masks by hand would have it.
FilledViews telea(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                  const Registration& registration, const Segmentation& segmentation, const TeleaParams& params) {
  const auto inpaint = [&](const cv::Mat& bgr, const cv::Mat& unknown) {
    cv::Mat result;
    cv::inpaint(bgr, unknown, result, params.radius_px, cv::INPAINT_TELEA);
    return result;
  };
  return fill_views(session, calibration, naked, registration, segmentation, params.depth, params.holes,
                    [&](const std::vector<GarmentView>& views, std::size_t k) {
                      const FilledGarment& garment = views[k].garment;
                      return inpainted_from(garment.color, garment.mask == 128, well_inside(garment), kTeleaMargin_px,
                                            inpaint);
                    });
}

const Fill::Variant telea_variant{"telea", telea};

}  // namespace
}  // namespace dressform
