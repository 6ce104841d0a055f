#include <utility>

#include "pipeline/texture/garment_views.h"
#include "pipeline/texture/light.h"

namespace dressform {
namespace {

struct LevelledParams {
  ViewParams view;
  GainParams gain;
  LabelParams label;
  AtlasParams atlas;
  BlendParams blend{0.05, 0.004};
  double unlit = 1;
};

template <class V>
void fields(V& v, LevelledParams& p) {
  v("erode_m", p.view.erode_m, 0.0, 0.05, "m", "taken off the garment's outline, at least a pixel");
  v("feather_m", p.view.feather_m, 0.0, 0.2, "m",
    "over which trust in a view rises from the garment's outline inwards");
  v("occluder_m", p.view.occluder_m, 0.0, 0.1, "m",
    "how near to the outline of something in front colours are not used");
  v("occluder_gap_m", p.view.occluder_gap_m, 0.005, 0.3, "m", "how much nearer a surface must be to count as in front");
  v("band_m", p.view.band_m, 0.002, 0.2, "m", "size of detail that divides the coarse from the fine band");
  v("filled_trust", p.view.filled_trust, 0.0, 1.0, "",
    "trust in colours that fill made up; 0: other views or the surface around");
  v("denoise", p.view.denoise, 0.0, 50.0, "",
    "range of the bilateral filter over the noise found in the image; 0: none");
  v("chroma_px", p.view.chroma_px, 0.0, 8.0, "px", "over which chroma is averaged where the luma is alike; 0: none");
  v("gain_least_facing", p.gain.least_facing, 0.05, 0.95, "",
    "least cosine of the viewing angle where views are compared");
  v("gain_least_vertices", p.gain.least_vertices, 1, 100000, "", "vertices two views must share to be compared");
  v("cutoff_deg", p.label.cutoff_deg, 30.0, 89.0, "deg", "surfaces more oblique are not coloured from a view");
  v("smoothness_m", p.label.smoothness_m, 0.0, 1.0, "m",
    "price of a metre of seam in square metres seen from the side");
  v("seam_contrast", p.label.seam_contrast, 1.0, 50.0, "",
    "how much dearer a seam is in a busy print than on plain cloth");
  v("texels_per_pixel", p.atlas.texels_per_pixel, 0.05, 4.0, "",
    "texels per pixel of the colour images, along each axis");
  v("gutter_px", p.atlas.gutter_px, 1, 32, "px", "space round every chart");
  v("largest_px", p.atlas.largest_px, 64, 16384, "px", "largest width and height of the texture");
  v("fine_blend_m", p.blend.fine_m, 0.0, 0.1, "m",
    "half width of the strip along a seam in which fine detail is blended");
  v("coarse_blend_m", p.blend.coarse_m, 0.0, 0.5, "m", "the same for coarse colour");
  v("unlit", p.unlit, 0.0, 1.0, "",
    "part of the room's light, as it falls on the naked body, that is taken off the cloth");
}

// Best views by graph cut (Lempitsky and Ivanov, CVPR 2007; Boykov, Veksler and Zabih, PAMI 2001), exposure levelled
// between them, two bands blended across the seams (Burt and Adelson, ACM TOG 1983).
TexturedGarments levelled(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                          const Registration& registration, const FilledViews& filled, const OpenGarments& opened,
                          const LevelledParams& params) {
  auto garments = garment_views(session, calibration, naked, registration, filled, opened, params.view);
  garments = levelled_exposure(std::move(garments), params.gain, params.view);
  if (params.unlit > 0)
    if (const auto light = light_on(naked, session.naked, calibration, registration))
      for (auto& [slot, each] : garments) each.unlit = unlit_gains(*light, *each.mesh, params.unlit);
  const auto choose = [&](const GarmentViews& garment, const SurfaceGraph& graph) {
    return label_triangles(*garment.mesh, graph, garment.samples, params.label);
  };
  return textured(garments, choose, params.blend, params.atlas, params.view);
}

const Texture::Variant levelled_variant{"levelled", levelled};

}  // namespace
}  // namespace dressform
