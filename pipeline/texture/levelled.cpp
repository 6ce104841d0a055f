#include <utility>

#include "pipeline/texture/gains.h"
#include "pipeline/texture/labels.h"
#include "pipeline/texture/paint.h"

namespace dressform {
namespace {

struct LevelledParams {
  ViewParams view;
  GainParams gain;
  LabelParams label;
  AtlasParams atlas;
  double fine_blend_m = 0.004;
  double coarse_blend_m = 0.05;
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
  v("denoise_levels", p.view.denoise_levels, 0.0, 50.0, "levels",
    "range sigma of the bilateral filter on the images; 0: none");
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
  v("fine_blend_m", p.fine_blend_m, 0.0, 0.1, "m",
    "half width of the strip along a seam in which fine detail is blended");
  v("coarse_blend_m", p.coarse_blend_m, 0.0, 0.5, "m", "the same for coarse colour");
}

struct Prepared {
  std::vector<ColorView> views;
  VertexSamples samples;
};

// Labels as weights of the views at the vertices, before they are spread.
Eigen::MatrixXf label_weights(const Mesh& mesh, const Labels& labels, std::size_t views) {
  Eigen::MatrixXf weights = Eigen::MatrixXf::Zero(mesh.vertices.size(), views);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (labels.view[i] >= 0)
      for (const int v : mesh.triangles[i]) weights(v, labels.view[i]) += 1;
  for (Eigen::Index v = 0; v < weights.rows(); ++v)
    if (const float sum = weights.row(v).sum(); sum > 0) weights.row(v) /= sum;
  return weights;
}

TexturedMesh textured(const Mesh& mesh, const Prepared& prepared, const LevelledParams& params, double& unseen_part) {
  const SurfaceGraph graph(mesh);
  const Labels labels = label_triangles(mesh, graph, prepared.views, prepared.samples, params.label);
  const Atlas atlas = make_atlas(mesh, graph, prepared.views, labels, params.atlas);
  const Eigen::MatrixXf chosen = label_weights(mesh, labels, prepared.views.size());
  const BlendWeights weights{spread_over_surface(graph, chosen, params.coarse_blend_m),
                             spread_over_surface(graph, chosen, params.fine_blend_m)};
  Painted painted = paint(mesh, graph, prepared.views, prepared.samples, atlas, weights, params.view);
  unseen_part = painted.unseen_part;
  return {mesh, texture_coordinates(atlas), painted.texture};
}

// Best views by graph cut, exposure levelled between them, two bands blended across the seams.
TexturedGarments levelled(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                          const Registration& registration, const FilledViews& filled, const OpenGarments& opened,
                          const LevelledParams& params) {
  std::vector<const Mesh*> scenery{&naked.body};
  for (const auto& [slot, garment] : opened.garments) scenery.push_back(&garment.mesh);
  std::map<std::string, Prepared> prepared;
  Overlaps overlaps;
  for (const auto& [slot, garment] : opened.garments) {
    Prepared& each = prepared[slot];
    if (const auto found = filled.garments.find(slot); found != filled.garments.end())
      each.views =
          color_views(session.sensors, calibration, registration, found->second, garment.mesh, scenery, params.view);
    each.samples = sample_vertices(garment.mesh, each.views, params.view);
    overlaps.add(each.views, each.samples, params.gain);
  }
  const auto gains = overlaps.gains(params.gain);
  TexturedGarments result;
  for (const auto& [slot, garment] : opened.garments) {
    Prepared& each = prepared[slot];
    for (ColorView& view : each.views)
      if (const auto gain = gains.find(view.sensor); gain != gains.end()) apply_gain(view, gain->second);
    each.samples = sample_vertices(garment.mesh, each.views, params.view);
    result.garments[slot] = textured(garment.mesh, each, params, result.unseen_part[slot]);
  }
  return result;
}

const Texture::Variant variant{"levelled", levelled};

}  // namespace
}  // namespace dressform
