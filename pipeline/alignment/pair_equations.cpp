#include "pipeline/alignment/pair_equations.h"

#include <cmath>

#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double kReach = 1.5;  // of Tukey's constant: what is farther off the plane is no pair

}  // namespace

Vector6d solve_twist(Matrix6d matrix, const Vector6d& vector) {
  constexpr double kDamping = 1e-9;  // keeps what no point holds where it is, and moves nothing else
  matrix.diagonal().array() += kDamping * matrix.trace();
  return matrix.ldlt().solve(vector);
}

bool negligible(const Vector6d& twist, double rotation_rad, double translation_m) {
  return twist.head<3>().norm() < rotation_rad && twist.tail<3>().norm() < translation_m;
}

Isometry3d exponential(const Vector6d& twist) {
  Isometry3d result = Isometry3d::Identity();
  const double angle = twist.head<3>().norm();
  if (angle > 1e-12) result.linear() = Eigen::AngleAxisd(angle, twist.head<3>() / angle).toRotationMatrix();
  result.translation() = twist.tail<3>();
  return result;
}

PairEquations pair_equations(const DepthMap& from, const std::vector<int>& samples, const DepthMap& to,
                             const Projector& projector, const Isometry3d& world_from_source,
                             const Isometry3d& world_from_target, const CorrespondenceRejector& gate) {
  const Isometry3d target_from_source = world_from_target.inverse() * world_from_source;
  const Eigen::Matrix3f rotation = target_from_source.linear().cast<float>();
  const Vector3f translation = target_from_source.translation().cast<float>();
  const auto reach = static_cast<float>(kReach * gate.distance_m);
  const float along_ray = 3 * reach;  // an oblique surface is that much farther along the ray than off its plane
  PairEquations result;
  for (std::size_t k = 0; k < samples.size(); k += gate.stride) {
    const int i = samples[k];
    const Vector3f point = rotation * from.points[i] + translation;
    Vector2f pixel;
    if (!projector(point, pixel)) continue;
    const int j = static_cast<int>(pixel.y() + 0.5f) * to.camera.width + static_cast<int>(pixel.x() + 0.5f);
    if (to.points[j].z() == 0) continue;
    // A point behind what the target saw is hidden there and says nothing.
    if (point.z() > to.points[j].z() + along_ray) continue;
    ++result.visible;
    result.cost += 1;
    if (!to.has_normal(j)) continue;
    const float residual = to.normals[j].dot(point - to.points[j]);
    if (std::abs(residual) > reach || std::abs(point.z() - to.points[j].z()) > along_ray) continue;
    if (to.normals[j].dot(rotation * from.normals[i]) < gate.normal_cosine) continue;
    const double variance = from.sigma_m[i] * from.sigma_m[i] + to.sigma_m[j] * to.sigma_m[j];
    const Tukey tukey(residual / gate.distance_m);
    result.cost += tukey.loss - 1;
    if (tukey.weight == 0) continue;
    const Vector3d normal = world_from_target.linear() * to.normals[j].cast<double>();
    const Vector3d world = world_from_target * point.cast<double>();
    Vector6d jacobian;
    jacobian << world.cross(normal), normal;
    const double weight = 1e-6 * tukey.weight / variance;  // of a residual in millimetres
    result.matrix.selfadjointView<Eigen::Lower>().rankUpdate(jacobian, weight);
    result.vector -= weight * residual * jacobian;
    result.squared_residual_m2 += residual * residual;
    ++result.inliers;
  }
  result.matrix = Matrix6d(result.matrix.selfadjointView<Eigen::Lower>());
  return result;
}

}  // namespace dressform
