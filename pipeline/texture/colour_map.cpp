// Zhou and Koltun, "Color map optimization for 3D reconstruction with consumer depth cameras", ACM TOG 2014, in the
// rigid form of Open3D's RunRigidOptimizer: cameras are moved until what they see agrees, and colours are means over
// the views. Open3D's knows no lens distortion and sums in the order of its threads; and it keeps colours at vertices,
// where here every texel has its mean.
#include <utility>

#include "pipeline/texture/garment_views.h"
#include "pipeline/texture/photo_consistency.h"

namespace dressform {
namespace {

struct ColourMapParams {
  ViewParams view = as_photographed();
  GainParams gain;
  PhotoConsistencyParams agree;
  LabelParams label;
  AtlasParams atlas;
};
template <class V>
void fields(V& v, ColourMapParams& p) {
  v("erode_m", p.view.erode_m, 0.0, 0.05, "m", "taken off the garment's outline, at least a pixel");
  v("rounds", p.agree.rounds, 0, 1000, "", "of averaging colours and moving cameras; 0: as registered");
  v("least_facing", p.agree.least_facing, 0.05, 0.95, "", "least cosine of the viewing angle where views are compared");
  v("cutoff_deg", p.label.cutoff_deg, 30.0, 89.0, "deg", "surfaces more oblique are not coloured from a view");
  v("texels_per_pixel", p.atlas.texels_per_pixel, 0.05, 4.0, "", "texels per pixel of the colour images, each way");
  v("largest_px", p.atlas.largest_px, 64, 16384, "px", "largest width and height of the texture");
}

// How much each view counts at each vertex in a mean over all that see it.
Eigen::MatrixXf mean_weights(const VertexSamples& samples) {
  Eigen::MatrixXf weights = samples.trust.cwiseProduct(samples.facing.cwiseMax(0.f));
  for (Eigen::Index v = 0; v < weights.rows(); ++v)
    if (const float sum = weights.row(v).sum(); sum > 0) weights.row(v) /= sum;
  return weights;
}

TexturedGarments colour_map(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                            const Registration& registration, const FilledViews& filled, const OpenGarments& opened,
                            const ColourMapParams& params) {
  auto garments = garment_views(session, calibration, naked, registration, filled, opened, params.view);
  garments = levelled_exposure(std::move(garments), params.gain, params.view);
  TexturedGarments result;
  for (auto& [slot, each] : garments) {
    const SurfaceGraph graph(*each.mesh);
    each.views = photo_consistent(*each.mesh, std::move(each.views), each.samples, params.agree);
    each.samples = sample_vertices(*each.mesh, each.views, params.view);
    const Labels labels = best_view_labels(*each.mesh, each.samples, params.label);
    const Atlas atlas = make_atlas(*each.mesh, graph, each.views, labels, params.atlas);
    const Eigen::MatrixXf weights = mean_weights(each.samples);
    const Painted painted =
        paint(*each.mesh, graph, each.views, each.samples, atlas, {weights, weights}, {}, params.view);
    result.garments[slot] = {*each.mesh, texture_coordinates(atlas), painted.texture};
    result.unseen_part[slot] = painted.unseen_part;
  }
  return result;
}

const Texture::Variant colour_map_variant{"colour_map", colour_map};

}  // namespace
}  // namespace dressform
