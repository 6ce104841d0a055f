#include "pipeline/texture/garment_views.h"

#include <utility>

namespace dressform {
namespace {

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

}  // namespace

std::map<std::string, GarmentViews> garment_views(const CaptureSession& session, const Calibration& calibration,
                                                  const BodyModel& naked, const Registration& registration,
                                                  const FilledViews& filled, const OpenGarments& opened,
                                                  const ViewParams& params) {
  std::vector<const Mesh*> scenery{&naked.body};
  for (const auto& [slot, garment] : opened.garments) scenery.push_back(&garment.mesh);
  std::map<std::string, GarmentViews> result;
  for (const auto& [slot, garment] : opened.garments) {
    GarmentViews& each = result[slot];
    each.mesh = &garment.mesh;
    if (const auto found = filled.garments.find(slot); found != filled.garments.end())
      each.views =
          color_views(session.sensors, calibration, registration, found->second, garment.mesh, scenery, params);
    each.samples = sample_vertices(garment.mesh, each.views, params);
  }
  return result;
}

std::map<std::string, GarmentViews> levelled_exposure(std::map<std::string, GarmentViews> garments,
                                                      const GainParams& gain, const ViewParams& params) {
  Overlaps overlaps;
  for (const auto& [slot, each] : garments) overlaps.add(each.views, each.samples, gain);
  const auto gains = overlaps.gains(gain);
  for (auto& [slot, each] : garments) {
    for (ColorView& view : each.views)
      if (const auto found = gains.find(view.sensor); found != gains.end()) apply_gain(view, found->second);
    each.samples = sample_vertices(*each.mesh, each.views, params);
  }
  return garments;
}

TexturedGarments textured(const std::map<std::string, GarmentViews>& garments, const ChooseViews& choose,
                          const BlendParams& blend, const AtlasParams& atlas_params, const ViewParams& params) {
  TexturedGarments result;
  for (const auto& [slot, each] : garments) {
    const SurfaceGraph graph(*each.mesh);
    const Labels labels = choose(each, graph);
    const Atlas atlas = make_atlas(*each.mesh, graph, each.views, labels, atlas_params);
    const Eigen::MatrixXf chosen = label_weights(*each.mesh, labels, each.views.size());
    const BlendWeights weights{spread_over_surface(graph, chosen, blend.coarse_m),
                               spread_over_surface(graph, chosen, blend.fine_m)};
    const Painted painted = paint(*each.mesh, graph, each.views, each.samples, atlas, weights, each.unlit, params);
    result.garments[slot] = {*each.mesh, texture_coordinates(atlas), painted.texture};
    result.unseen_part[slot] = painted.unseen_part;
  }
  return result;
}

}  // namespace dressform
