#include "pipeline/texture/labels.h"

#include <algorithm>
#include <cmath>

#include "pipeline/texture/alpha_expansion.h"

namespace dressform {
namespace {

constexpr double kBusy = 40;       // levels between the ends of an edge from which on a print is as busy as any
constexpr double kUnseenCost = 6;  // against 0 (seen straight on) to 1 (seen from the side)

struct Sight {
  double facing = 0, trust = 0;
};

Sight sight_of(const Vector3i& t, const VertexSamples& samples, Eigen::Index view) {
  Sight sight;
  for (int k = 0; k < 3; ++k) {
    sight.facing += samples.facing(t[k], view) / 3;
    sight.trust += samples.trust(t[k], view) / 3;
  }
  return sight;
}

double cost_of(const Sight& sight, double least_facing) {
  const double oblique = std::min(1.0, (1 - sight.facing) * (1 - sight.facing));
  if (sight.facing < least_facing) return kUnseenCost + oblique;
  return oblique + kUnseenCost * (1 - sight.trust);
}

// Rows triangles, columns views.
Eigen::MatrixXd costs_of(const Mesh& mesh, const VertexSamples& samples, const LabelParams& params) {
  const double least_facing = std::cos(params.cutoff_deg * M_PI / 180);
  Eigen::MatrixXd costs(mesh.triangles.size(), samples.trust.cols());
  for (Eigen::Index i = 0; i < costs.rows(); ++i)
    for (Eigen::Index j = 0; j < costs.cols(); ++j)
      costs(i, j) = cost_of(sight_of(mesh.triangles[i], samples, j), least_facing);
  return costs;
}

Labels labels_from(const Mesh& mesh, const VertexSamples& samples, const LabelParams& params,
                   const std::vector<int>& chosen) {
  const double least_facing = std::cos(params.cutoff_deg * M_PI / 180);
  Labels labels;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Sight sight = sight_of(mesh.triangles[i], samples, chosen[i]);
    labels.view.push_back(chosen[i]);
    labels.covered.push_back(sight.facing >= least_facing && sight.trust > 0);
  }
  return labels;
}

// How busy the print is across an edge, 0 to 1: the difference of the blurred colours of its ends in the view that
// sees it best.
double contrast_at(const SurfaceGraph::Edge& edge, const VertexSamples& samples) {
  Eigen::Index best = 0;
  (samples.trust.row(edge.a) + samples.trust.row(edge.b)).maxCoeff(&best);
  const float difference = (samples.low[best].row(edge.a) - samples.low[best].row(edge.b)).cwiseAbs().maxCoeff();
  return std::min(1.0, difference / kBusy);
}

}  // namespace

Labels best_view_labels(const Mesh& mesh, const VertexSamples& samples, const LabelParams& params) {
  if (samples.trust.cols() == 0)
    return {std::vector<int>(mesh.triangles.size(), -1), std::vector<bool>(mesh.triangles.size(), false)};
  return labels_from(mesh, samples, params, alpha_expansion(costs_of(mesh, samples, params), {}));
}

Labels label_triangles(const Mesh& mesh, const SurfaceGraph& graph, const VertexSamples& samples,
                       const LabelParams& params) {
  if (samples.trust.cols() == 0 || mesh.triangles.empty()) return best_view_labels(mesh, samples, params);
  Eigen::MatrixXd costs = costs_of(mesh, samples, params);
  for (Eigen::Index i = 0; i < costs.rows(); ++i) costs.row(i) *= graph.triangle_area_m2[i];
  std::vector<PottsEdge> seams;
  for (const SurfaceGraph::Edge& edge : graph.edges) {
    if (edge.right < 0) continue;
    const double contrast = 1 + (params.seam_contrast - 1) * contrast_at(edge, samples);
    seams.push_back({edge.left, edge.right, edge.length_m * params.smoothness_m * contrast});
  }
  return labels_from(mesh, samples, params, alpha_expansion(costs, seams));
}

Labels sector_labels(const Mesh& mesh, const std::vector<ColorView>& views, const VertexSamples& samples,
                     const LabelParams& params) {
  if (views.empty() || mesh.triangles.empty()) return best_view_labels(mesh, samples, params);
  Vector3d axis = Vector3d::Zero();
  for (const Vector3d& v : mesh.vertices) axis += v / static_cast<double>(mesh.vertices.size());
  const auto level = [&](const Vector3d& p) { return Vector2d(p.x() - axis.x(), p.z() - axis.z()).normalized(); };
  std::vector<int> chosen;
  for (const Vector3i& t : mesh.triangles) {
    const Vector2d outwards = level((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3);
    int best = 0;
    for (int i = 1; i < static_cast<int>(views.size()); ++i)
      if (outwards.dot(level(views[i].eye)) > outwards.dot(level(views[best].eye))) best = i;
    chosen.push_back(best);
  }
  return labels_from(mesh, samples, params, chosen);
}

}  // namespace dressform
