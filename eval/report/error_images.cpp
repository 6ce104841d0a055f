#include "eval/report/error_images.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "pipeline/geometry/mesh_query.h"

namespace dressform {
namespace {

constexpr int kHeight = 460;
constexpr double kScaleMm = 10;

Mesh moved(const Mesh& mesh, const Isometry3d& target_from_source) {
  return transformed(mesh, target_from_source.matrix());
}

Figure heat_map(const std::string& name, const std::string& title, const Mesh& mesh, const Mesh& truth,
                Renderer& renderer) {
  RenderItem item;
  item.mesh = &mesh;
  item.shading = Shading::scalar;
  item.scalars = vertex_distances_mm(mesh, truth);
  item.scalar_minimum = 0;
  item.scalar_maximum = kScaleMm;
  const cv::Mat image = with_color_bar(four_views(renderer, {item}, kHeight), 0, kScaleMm, "mm", "distance to truth");
  return {name, title, "Distance of the reconstruction to the true surface: front, left, back, right.", image};
}

RenderItem unlit(const TexturedMesh& mesh) {
  RenderItem item;
  item.textured = &mesh;
  item.shading = Shading::unlit;
  return item;
}

// Truth above, estimate below, seen from between the sensors.
Figure beside_truth(const std::string& slot, const TexturedMesh& truth, const TexturedMesh& estimate,
                    Renderer& renderer) {
  Eigen::AlignedBox3d box;
  for (const auto& vertex : truth.mesh.vertices) box.extend(vertex);
  std::vector<cv::Mat> above, below;
  for (const double azimuth : {45.0, 135.0, 225.0, 315.0}) {
    const auto view = look_at_box(box.min(), box.max(), azimuth, 5, 340, kHeight);
    above.push_back(renderer.render(view, {unlit(truth)}));
    below.push_back(renderer.render(view, {unlit(estimate)}));
  }
  return {
      "heldout_" + slot, slot + ", truth above, reconstruction below",
      "Unlit texture from 45, 135, 225 and 315 degrees, where no sensor stood.",
      stacked({titled(side_by_side(above, kHeight), "truth"), titled(side_by_side(below, kHeight), "reconstruction")})};
}

}  // namespace

std::vector<double> vertex_distances_mm(const Mesh& mesh, const Mesh& truth) {
  const MeshQuery query(truth);
  std::vector<double> result(mesh.vertices.size());
  tbb::parallel_for(std::size_t{0}, result.size(),
                    [&](std::size_t i) { result[i] = 1000 * query.closest(mesh.vertices[i]).distance; });
  return result;
}

std::vector<Figure> error_figures(const Reconstruction& made, const GroundTruth& truth, Renderer& renderer) {
  std::vector<Figure> figures;
  const auto& poses = made.registration.get().model_from_sensor;
  const auto first = made.sensors.empty() ? poses.end() : poses.find(made.sensors.front());
  if (first == poses.end() || !truth.world_from_sensor.count(made.sensors.front())) return figures;
  const Isometry3d world_from_model = truth.world_from_sensor.at(made.sensors.front()) * first->second.inverse();
  const Mesh& body = made.naked.get().body;
  if (!body.triangles.empty() && !truth.naked_body.triangles.empty())
    figures.push_back(
        heat_map("error_body", "Scanned mannequin", moved(body, world_from_model), truth.naked_body, renderer));
  for (const auto& [slot, garment] : made.textured.get().garments) {
    const auto real = truth.garments.find(slot);
    if (real == truth.garments.end()) continue;
    const TexturedMesh estimate{moved(garment.mesh, world_from_model), garment.corner_uv, garment.texture};
    figures.push_back(heat_map("error_" + slot, slot, estimate.mesh, real->second.mesh, renderer));
    if (!real->second.textured.texture.empty())
      figures.push_back(beside_truth(slot, real->second.textured, estimate, renderer));
  }
  return figures;
}

}  // namespace dressform
