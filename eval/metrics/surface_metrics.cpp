#include "eval/metrics/surface_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "eval/metrics/sampling.h"

namespace dressform::metrics {
namespace {

constexpr double kMm = 1000;

// The triangles whose corners are all observed.
Mesh observed_part(const Mesh& truth, const std::vector<std::uint8_t>& views) {
  Mesh part{truth.vertices, {}};
  for (const auto& t : truth.triangles)
    if (views[t[0]] && views[t[1]] && views[t[2]]) part.triangles.push_back(t);
  return part;
}

std::vector<double> distances_mm(const std::vector<NearestOnMesh>& nearest) {
  std::vector<double> result(nearest.size());
  for (std::size_t i = 0; i < nearest.size(); ++i) result[i] = nearest[i].distance_m * kMm;
  return result;
}

double share_within(const std::vector<double>& distances, double limit) {
  if (distances.empty()) return 0;
  const auto within = std::count_if(distances.begin(), distances.end(), [&](double d) { return d <= limit; });
  return static_cast<double>(within) / static_cast<double>(distances.size());
}

// Distances of points to a mesh that may be empty.
std::vector<double> distances_mm(const std::vector<Vector3d>& points, const Mesh& mesh) {
  if (mesh.triangles.empty()) return std::vector<double>(points.size(), std::numeric_limits<double>::infinity());
  return points.empty() ? std::vector<double>{} : distances_mm(MeshDistance(mesh).nearest(points));
}

void compare_normals(const Mesh& estimate, const Mesh& truth, const SurfaceSamples& samples,
                     const std::vector<NearestOnMesh>& nearest, const std::vector<bool>& judged,
                     SurfaceComparison& result) {
  std::vector<double> cosines, magnitudes;
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    if (!judged[i]) continue;
    const double cosine =
        triangle_normal(estimate, samples.triangles[i]).dot(triangle_normal(truth, nearest[i].triangle));
    cosines.push_back(cosine);
    magnitudes.push_back(std::abs(cosine));
  }
  result.normal_consistency = mean(magnitudes);
  result.normal_consistency_signed = mean(cosines);
}

}  // namespace

double f_score(double precision, double recall) {
  return precision + recall > 0 ? 2 * precision * recall / (precision + recall) : 0;
}

SurfaceComparison compare_surfaces(const Mesh& estimate, const Mesh& truth, const std::vector<std::uint8_t>& views,
                                   const SurfaceComparisonOptions& options) {
  if (!views.empty() && views.size() != truth.vertices.size())
    throw std::invalid_argument("compare_surfaces: one view count per vertex of the truth");
  const auto seen = [&](int vertex) { return views.empty() || views[vertex] > 0; };
  const SurfaceSamples from_estimate = sample_surface(estimate, options.spacing_m, options.seed);
  const SurfaceSamples from_truth = sample_surface(truth, options.spacing_m, options.seed + 1);
  if (from_estimate.points.empty() || from_truth.points.empty())
    throw std::invalid_argument("compare_surfaces: a mesh without area");

  const auto to_truth = MeshDistance(truth).nearest(from_estimate.points);
  std::vector<bool> judged(to_truth.size());
  std::vector<double> accuracy;
  std::vector<Vector3d> unjudged;
  for (std::size_t i = 0; i < to_truth.size(); ++i) {
    judged[i] = seen(to_truth[i].nearest_vertex);
    if (judged[i])
      accuracy.push_back(to_truth[i].distance_m * kMm);
    else
      unjudged.push_back(from_estimate.points[i]);
  }
  std::vector<Vector3d> observed;
  for (std::size_t i = 0; i < from_truth.points.size(); ++i)
    if (seen(from_truth.nearest_vertices[i])) observed.push_back(from_truth.points[i]);
  const std::vector<double> completeness = distances_mm(observed, estimate);
  const auto unjudged_to_observed = distances_mm(unjudged, views.empty() ? truth : observed_part(truth, views));

  SurfaceComparison result;
  for (const int threshold : options.thresholds_mm) {
    const double right = share_within(accuracy, threshold) * static_cast<double>(accuracy.size());
    const double more = share_within(unjudged_to_observed, threshold) * static_cast<double>(unjudged.size());
    const double asked = static_cast<double>(accuracy.size()) + more;
    result.precision[threshold] = asked > 0 ? (right + more) / asked : 0;
    result.recall[threshold] = share_within(completeness, threshold);
    result.f[threshold] = f_score(result.precision[threshold], result.recall[threshold]);
  }
  result.accuracy_mm = mean(accuracy);
  result.accuracy_median_mm = quantile(accuracy, 0.5);
  result.completeness_mm = mean(completeness);
  result.completeness_median_mm = quantile(completeness, 0.5);
  result.chamfer_l1_mm = (result.accuracy_mm + result.completeness_mm) / 2;
  result.hausdorff_mm = std::max(quantile(accuracy, 1), quantile(completeness, 1));
  result.hd95_mm = std::max(quantile(accuracy, 0.95), quantile(completeness, 0.95));
  compare_normals(estimate, truth, from_estimate, to_truth, judged, result);
  result.unobserved_part = 1 - static_cast<double>(observed.size()) / static_cast<double>(from_truth.points.size());
  result.estimate_unjudged_part = static_cast<double>(unjudged.size()) / static_cast<double>(to_truth.size());
  result.estimate_samples = static_cast<long>(from_estimate.points.size());
  result.truth_samples = static_cast<long>(from_truth.points.size());
  return result;
}

}  // namespace dressform::metrics
