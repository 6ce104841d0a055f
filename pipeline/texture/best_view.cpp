#include "pipeline/texture/garment_views.h"

namespace dressform {
namespace {

struct BestViewParams {
  ViewParams view = as_photographed();
  LabelParams label;
  AtlasParams atlas;
};

template <class V>
void fields(V& v, BestViewParams& p) {
  v("erode_m", p.view.erode_m, 0.0, 0.05, "m", "taken off the garment's outline, at least a pixel");
  v("cutoff_deg", p.label.cutoff_deg, 30.0, 89.0, "deg", "surfaces more oblique are not coloured from a view");
  v("texels_per_pixel", p.atlas.texels_per_pixel, 0.05, 4.0, "", "texels per pixel of the colour images, each way");
  v("largest_px", p.atlas.largest_px, 64, 16384, "px", "largest width and height of the texture");
}

// Every triangle from the one view that sees it best, as photographed: neither levelled nor blended. A baseline: the
// data term alone of Lempitsky and Ivanov, CVPR 2007.
TexturedGarments best_view(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                           const Registration& registration, const FilledViews& filled, const OpenGarments& opened,
                           const BestViewParams& params) {
  const auto garments = garment_views(session, calibration, naked, registration, filled, opened, params.view);
  const auto choose = [&](const GarmentViews& garment, const SurfaceGraph&) {
    return best_view_labels(*garment.mesh, garment.samples, params.label);
  };
  return textured(garments, choose, {0, 0}, params.atlas, params.view);
}

const Texture::Variant best_view_variant{"best_view", best_view};

}  // namespace
}  // namespace dressform
