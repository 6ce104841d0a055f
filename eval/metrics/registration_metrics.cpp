#include "eval/metrics/registration_metrics.h"

#include <cmath>

#include "eval/metrics/mesh_distance.h"
#include "eval/metrics/sampling.h"

namespace dressform::metrics {

double rotation_error_deg(const Isometry3d& estimate, const Isometry3d& truth) {
  const Eigen::Quaterniond q(Eigen::Matrix3d(estimate.linear() * truth.linear().transpose()));
  return 2 * std::atan2(q.vec().norm(), std::abs(q.w())) * 180 / M_PI;
}

double translation_error_mm(const Isometry3d& estimate, const Isometry3d& truth) {
  return (estimate.translation() - truth.translation()).norm() * 1000;
}

double target_registration_error_mm(const Isometry3d& estimate, const Isometry3d& truth,
                                    const std::vector<Vector3d>& world_points) {
  const Isometry3d estimate_from_truth = estimate * truth.inverse();
  std::vector<double> squares;
  squares.reserve(world_points.size());
  for (const auto& point : world_points) squares.push_back((estimate_from_truth * point - point).squaredNorm());
  return std::sqrt(mean(squares)) * 1000;
}

std::vector<Vector3d> points_seen(const Mesh& world_mesh, const Isometry3d& world_from_sensor, double spacing_m,
                                  std::uint64_t seed) {
  const SurfaceSamples samples = sample_surface(world_mesh, spacing_m, seed);
  const MeshDistance surface(world_mesh);
  const Vector3d eye = world_from_sensor.translation();
  std::vector<Vector3d> seen;
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    const bool faces = triangle_normal(world_mesh, samples.triangles[i]).dot(eye - samples.points[i]) > 0;
    if (faces && surface.sees(eye, samples.points[i])) seen.push_back(samples.points[i]);
  }
  return seen;
}

}  // namespace dressform::metrics
