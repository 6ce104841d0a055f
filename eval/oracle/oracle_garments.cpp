// What the stages of the clothes would have given.
#include <tbb/parallel_for.h>

#include <cmath>

#include "eval/metrics/mesh_distance.h"
#include "eval/oracle/capped.h"
#include "eval/oracle/oracle_frames.h"
#include "eval/oracle/true_layout.h"
#include "pipeline/garment/sleeves.h"
#include "scenes/error.h"

namespace dressform {
namespace {

constexpr double kMargin_m = 0.05;    // of a closed garment beyond its ends: as the surface stage's own
constexpr double kObserved = 0.5;     // a rim of which less is visible counts as unseen, as in the scores
constexpr double kGutter_texels = 2;  // beyond a chart's edge, so that nothing else's colour is drawn into it

void give_segmentation(const OracleInput& input, GivenArtifacts& given) {
  if (input.truth.labels.empty()) throw InputError("truth", "has no labels; expected an image a sensor");
  Segmentation result = input.made.segmentation.get();
  for (const auto& [sensor, labels] : input.truth.labels) result.labels[sensor] = labels;
  result.garments = true_layouts(input, false);
  given.give<Segment>("segment", result);
}

void give_surface(const OracleInput& input, GivenArtifacts& given) {
  ClosedGarments result;
  const auto& found = input.made.closed.get().garments;
  for (const auto& [slot, layout] : true_layouts(input, true)) {
    ClosedGarment& garment = result.garments[slot];
    const Mesh open = garment_in_model(input, slot);
    garment.mesh = capped(open, kMargin_m);
    garment.layout = layout;
    if (const auto own = found.find(slot); own != found.end()) {
      garment.support = own->second.support;  // the points stay what the sensors saw
      continue;
    }
    garment.support.points = open.vertices;
    garment.support.normals = vertex_normals(open);
    garment.support.views.assign(open.vertices.size(), 0);
  }
  given.give<Surface>("surface", result);
}

void give_opened(const OracleInput& input, GivenArtifacts& given) {
  const Isometry3d model_from_world = model_from_world_by_gauge(input);
  OpenGarments result;
  for (const auto& [slot, layout] : true_layouts(input, true)) {
    OpenGarment& garment = result.garments[slot];
    garment.mesh = garment_in_model(input, slot);
    garment.layout = with_sleeve_ends(layout, garment.mesh, input.made.landmarks.get());
    const auto rims = input.truth.rims.find(slot);
    if (rims == input.truth.rims.end()) throw InputError("truth", "has no rims of " + slot + "; expected them");
    for (const auto& rim : rims->second) {
      garment.rims.push_back({rim.name, {}, rim.visible >= kObserved, {}});
      for (const auto& point : rim.points) garment.rims.back().points.push_back(model_from_world * point);
    }
  }
  given.give<Open>("open", result);
}

// The colour of a textured mesh at barycentric weights of a triangle: of the nearest texel.
cv::Vec3b print_at(const TexturedMesh& mesh, int triangle, const Vector3d& weights) {
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();
  for (int k = 0; k < 3; ++k) uv += weights[k] * mesh.corner_uv[triangle][k].cast<double>();
  const int x = static_cast<int>(std::floor(uv.x() * mesh.texture.cols));
  const int y = static_cast<int>(std::floor(uv.y() * mesh.texture.rows));
  return mesh.texture.at<cv::Vec3b>(std::clamp(y, 0, mesh.texture.rows - 1), std::clamp(x, 0, mesh.texture.cols - 1));
}

struct Texel {
  int x = 0, y = 0;
  Vector3d point;  // of the surface, model frame
};

// The texels whose centres lie in a triangle's chart, or within the gutter about it.
void add_texels(const TexturedMesh& mesh, int triangle, double gutter, std::vector<Texel>& texels) {
  Eigen::Vector2d corner[3];
  for (int k = 0; k < 3; ++k)
    corner[k] =
        mesh.corner_uv[triangle][k].cast<double>().cwiseProduct(Eigen::Vector2d(mesh.texture.cols, mesh.texture.rows)) -
        Eigen::Vector2d(0.5, 0.5);
  Eigen::Matrix2d sides;
  sides << corner[1] - corner[0], corner[2] - corner[0];
  if (std::abs(sides.determinant()) < 1e-9) return;
  const Eigen::Matrix2d inverse = sides.inverse();
  const auto low = corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]).eval();
  const auto high = corner[0].cwiseMax(corner[1]).cwiseMax(corner[2]).eval();
  double slack[3];  // of a weight, a gutter's width beyond the side opposite to its corner
  for (int k = 0; k < 3; ++k)
    slack[k] = gutter * (corner[(k + 2) % 3] - corner[(k + 1) % 3]).norm() / std::abs(sides.determinant());
  for (int y = std::max(0, int(std::ceil(low.y() - gutter))); y <= std::min(mesh.texture.rows - 1.0, high.y() + gutter);
       ++y)
    for (int x = std::max(0, int(std::ceil(low.x() - gutter)));
         x <= std::min(mesh.texture.cols - 1.0, high.x() + gutter); ++x) {
      const Eigen::Vector2d st = inverse * (Eigen::Vector2d(x, y) - corner[0]);
      const Vector3d weights(1 - st.sum(), st.x(), st.y());
      if (weights[0] < -slack[0] || weights[1] < -slack[1] || weights[2] < -slack[2]) continue;
      Texel texel{x, y, Vector3d::Zero()};
      for (int k = 0; k < 3; ++k) texel.point += weights[k] * mesh.mesh.vertices[mesh.mesh.triangles[triangle][k]];
      texels.push_back(texel);
    }
}

// The garment as the run has it, each texel with the print that the true surface has nearest to it. Gutters first, so
// that no chart's own texel is drawn over.
TexturedMesh with_true_print(TexturedMesh garment, const TexturedMesh& truth, const Isometry3d& world_from_model) {
  const metrics::MeshDistance surface(truth.mesh);
  garment.texture = garment.texture.clone();
  for (const double gutter : {kGutter_texels, 0.0}) {
    std::vector<Texel> texels;
    for (int t = 0; t < static_cast<int>(garment.mesh.triangles.size()); ++t) add_texels(garment, t, gutter, texels);
    std::vector<Vector3d> points;
    for (const auto& texel : texels) points.push_back(world_from_model * texel.point);
    const auto nearest = surface.nearest(points);
    for (std::size_t i = 0; i < texels.size(); ++i)
      garment.texture.at<cv::Vec3b>(texels[i].y, texels[i].x) =
          print_at(truth, nearest[i].triangle, nearest[i].weights);
  }
  return garment;
}

void give_textured(const OracleInput& input, GivenArtifacts& given) {
  const Isometry3d world_from_model = model_from_world_by_gauge(input).inverse();
  TexturedGarments result = input.made.textured.get();
  for (auto& [slot, garment] : result.garments) {
    const auto truth = input.truth.garments.find(slot);
    if (truth == input.truth.garments.end()) continue;  // nobody wears it: it has no true print
    if (truth->second.textured.mesh.triangles.empty() || truth->second.textured.texture.empty())
      throw InputError("truth", "has no print of " + slot + "; expected its GLB");
    garment = with_true_print(garment, truth->second.textured, world_from_model);
    result.unseen_part[slot] = 0;
  }
  given.give<Texture>("texture", result);
}

const Oracle segment_oracle{"segment", give_segmentation}, surface_oracle{"surface", give_surface},
    open_oracle{"open", give_opened}, texture_oracle{"texture", give_textured};

}  // namespace
}  // namespace dressform
