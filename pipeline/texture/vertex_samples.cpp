#include "pipeline/texture/vertex_samples.h"

#include <tbb/parallel_for.h>

namespace dressform {

VertexSamples sample_vertices(const Mesh& mesh, const std::vector<ColorView>& views, const ViewParams& params) {
  const auto count = static_cast<Eigen::Index>(mesh.vertices.size());
  const auto columns = static_cast<Eigen::Index>(views.size());
  const std::vector<Vector3d> normals = vertex_normals(mesh);
  VertexSamples samples;
  samples.trust = Eigen::MatrixXf::Zero(count, columns);
  samples.facing = Eigen::MatrixXf::Zero(count, columns);
  samples.low.assign(views.size(), Eigen::MatrixXf::Zero(count, 3));
  tbb::parallel_for(Eigen::Index{0}, count, [&](Eigen::Index v) {
    for (Eigen::Index i = 0; i < columns; ++i) {
      const ColorView& view = views[i];
      samples.facing(v, i) = static_cast<float>(normals[v].dot((view.eye - mesh.vertices[v]).normalized()));
      Vector2d pixel;
      double z_m = 0;
      if (!view.project(mesh.vertices[v], pixel, z_m)) continue;
      samples.trust(v, i) = view.trust_at(pixel, z_m, params.occluder_gap_m);
      const cv::Vec3f low = linear3(view.low, pixel);
      for (int c = 0; c < 3; ++c) samples.low[i](v, c) = low[c];
    }
  });
  return samples;
}

}  // namespace dressform
