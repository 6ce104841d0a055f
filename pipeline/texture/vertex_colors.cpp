// One colour for each vertex, the mean of the views that see it: what one gets from Open3D, MeshLab or any surface made
// of coloured points (colour as a vertex attribute: Curless and Levoy, SIGGRAPH 1996, averaged like distances). As fine
// as the mesh is. Put into a texture, because garments have one.
#include <cmath>

#include "pipeline/texture/garment_views.h"

namespace dressform {
namespace {

struct VertexColorsParams {
  ViewParams view = as_photographed();
  LabelParams label;
  AtlasParams atlas;
};
template <class V>
void fields(V& v, VertexColorsParams& p) {
  v("erode_m", p.view.erode_m, 0.0, 0.05, "m", "taken off the garment's outline, at least a pixel");
  v("cutoff_deg", p.label.cutoff_deg, 30.0, 89.0, "deg", "surfaces more oblique are not coloured from a view");
  v("texels_per_pixel", p.atlas.texels_per_pixel, 0.05, 4.0, "", "texels per pixel of the colour images, each way");
  v("largest_px", p.atlas.largest_px, 64, 16384, "px", "largest width and height of the texture");
}

struct VertexMeans {
  Eigen::MatrixXf colors;   // vertices x 3, BGR levels
  std::vector<bool> known;  // that a view sees the vertex
};

// Means over the views, by trust and the cosine of the angle, as fused distances are weighted.
VertexMeans vertex_means(const GarmentViews& garment, double cutoff_deg) {
  const auto count = static_cast<Eigen::Index>(garment.mesh->vertices.size());
  const auto least = static_cast<float>(std::cos(cutoff_deg * M_PI / 180));
  VertexMeans means{Eigen::MatrixXf::Constant(count, 3, 128), std::vector<bool>(static_cast<std::size_t>(count))};
  for (Eigen::Index v = 0; v < count; ++v) {
    Eigen::RowVector3f sum = Eigen::RowVector3f::Zero();
    float weights = 0;
    for (std::size_t i = 0; i < garment.views.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      const float facing = garment.samples.facing(v, column), weight = garment.samples.trust(v, column) * facing;
      Vector2d pixel;
      double z_m = 0;
      if (facing < least || weight <= 0 || !garment.views[i].project(garment.mesh->vertices[v], pixel, z_m)) continue;
      const cv::Vec3f color = linear3(garment.views[i].color, pixel);
      sum += weight * Eigen::RowVector3f(color[0], color[1], color[2]);
      weights += weight;
    }
    means.known[v] = weights > 0;
    if (weights > 0) means.colors.row(v) = sum / weights;
  }
  return means;
}

// Part of the area whose corners no view sees.
double uncolored_part(const Mesh& mesh, const SurfaceGraph& graph, const std::vector<bool>& known) {
  double area = 0, unseen = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3i& t = mesh.triangles[i];
    area += graph.triangle_area_m2[i];
    if (!known[t[0]] && !known[t[1]] && !known[t[2]]) unseen += graph.triangle_area_m2[i];
  }
  return area > 0 ? unseen / area : 1;
}

TexturedGarments vertex_colors(const CaptureSession& session, const Calibration& calibration, const BodyModel& naked,
                               const Registration& registration, const FilledViews& filled, const OpenGarments& opened,
                               const VertexColorsParams& params) {
  TexturedGarments result;
  for (const auto& [slot, each] :
       garment_views(session, calibration, naked, registration, filled, opened, params.view)) {
    const SurfaceGraph graph(*each.mesh);
    const VertexMeans means = vertex_means(each, params.label.cutoff_deg);
    const Labels labels = best_view_labels(*each.mesh, each.samples, params.label);
    const Atlas atlas = make_atlas(*each.mesh, graph, each.views, labels, params.atlas);
    const Eigen::MatrixXf colors = fill_over_surface(graph, means.colors, means.known);
    result.garments[slot] = {*each.mesh, texture_coordinates(atlas), paint_vertex_colors(*each.mesh, atlas, colors)};
    result.unseen_part[slot] = uncolored_part(*each.mesh, graph, means.known);
  }
  return result;
}

const Texture::Variant vertex_colors_variant{"vertex_colors", vertex_colors};

}  // namespace
}  // namespace dressform
