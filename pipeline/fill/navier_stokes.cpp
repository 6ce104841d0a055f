#include <opencv2/photo.hpp>

#include "pipeline/fill/fill_views.h"
#include "pipeline/fill/garment_inpaint.h"

namespace dressform {
namespace {

struct NavierStokesParams {
  GarmentDepthParams depth;
  HoleParams holes;
  double radius_px = 3;
};
template <class V>
void fields(V& v, NavierStokesParams& p) {
  shared_fields(v, p.depth, p.holes);
  v("radius_px", p.radius_px, 1, 30, "px", "of the neighbourhood that the flow is taken from; 3 is the usual one");
}

constexpr int kNavierStokesMargin_px = 12;  // round the hole: more than any usual radius

// The photograph's lines of even colour carried on into the hole as a fluid's streamlines would be (Bertalmio, Bertozzi
// and Sapiro, "Navier-Stokes, fluid dynamics, and image and video inpainting", CVPR 2001), by OpenCV. Depth and holes
// as in all variants; only pixels of the garment lend colours.
FilledViews navier_stokes(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                          const Registration& registration, const Segmentation& segmentation,
                          const NavierStokesParams& params) {
  const auto inpaint = [&](const cv::Mat& bgr, const cv::Mat& unknown) {
    cv::Mat result;
    cv::inpaint(bgr, unknown, result, params.radius_px, cv::INPAINT_NS);
    return result;
  };
  return fill_views(session, calibration, naked, registration, segmentation, params.depth, params.holes,
                    [&](const std::vector<GarmentView>& views, std::size_t k) {
                      const FilledGarment& garment = views[k].garment;
                      return inpainted_from(garment.color, garment.mask == 128, well_inside(garment),
                                            kNavierStokesMargin_px, inpaint);
                    });
}

const Fill::Variant navier_stokes_variant{"navier_stokes", navier_stokes};

}  // namespace
}  // namespace dressform
