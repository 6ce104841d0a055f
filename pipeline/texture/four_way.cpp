#include "pipeline/texture/garment_views.h"

namespace dressform {
namespace {

struct FourWayParams {
  ViewParams view = projected_blindly();
  GainParams gain;
  LabelParams label;
  AtlasParams atlas;
};

template <class V>
void fields(V& v, FourWayParams& p) {
  v("erode_m", p.view.erode_m, 0.0, 0.05, "m", "taken off the garment's outline, at least a pixel");
  v("largest_px", p.atlas.largest_px, 64, 16384, "px", "largest width and height of the texture");
}

// The thesis's texture (section 3.5) without the hand: the mesh cut upright into one part a view, each coloured from
// its photograph with no test of visibility. Where the thesis evened out exposure by hand and cut by picked points,
// gains from overlaps and the sectors between the sensors stand in.
TexturedGarments four_way(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                          const Registration& registration, const FilledViews& filled, const OpenGarments& opened,
                          const FourWayParams& params) {
  auto garments = garment_views(session, calibration, naked, registration, filled, opened, params.view);
  garments = levelled_exposure(std::move(garments), params.gain, params.view);
  const auto choose = [&](const GarmentViews& garment, const SurfaceGraph&) {
    return sector_labels(*garment.mesh, garment.views, garment.samples, params.label);
  };
  return textured(garments, choose, {0, 0}, params.atlas, params.view);
}

const Texture::Variant four_way_variant{"four_way", four_way};

}  // namespace
}  // namespace dressform
