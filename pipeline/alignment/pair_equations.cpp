#include "pipeline/alignment/pair_equations.h"

#include <array>
#include <cmath>

#include "scenes/small_solvers.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double kReach = 1.5;  // of Tukey's constant: what is farther off the plane is no pair

// Half of the time went by waiting for memory: the target's pixels lie anywhere. They are asked for a block ahead.
constexpr int kBlock = 32, kAhead = 8;

// A source point and where it falls in the target's image.
struct Candidate {
  Vector3f point;  // target's frame
  int from, to;    // indices of the maps
};

class Pairing {
 public:
  Pairing(const DepthMap& from, const DepthMap& to, const Isometry3d& target_from_source,
          const Isometry3d& world_from_target, const CorrespondenceRejector& gate)
      : from_(from),
        to_(to),
        rotation_(target_from_source.linear().cast<float>()),
        translation_(target_from_source.translation().cast<float>()),
        world_from_target_(world_from_target),
        gate_(gate),
        reach_(static_cast<float>(kReach * gate.distance_m)),
        along_ray_(3 * reach_) {}

  // False where the point falls outside the image. What `add` is going to read is asked for now.
  bool find(int sample, const Projector& projector, Candidate& found) const {
    found.from = sample;
    found.point = turned(from_.points[sample]) + translation_;
    Vector2f pixel;
    if (!projector(found.point, pixel)) return false;
    found.to = static_cast<int>(pixel.y() + 0.5f) * to_.camera.width + static_cast<int>(pixel.x() + 0.5f);
    __builtin_prefetch(&to_.points[found.to]);
    __builtin_prefetch(&to_.normals[found.to]);
    __builtin_prefetch(&from_.normals[sample]);
    return true;
  }

  void add(const Candidate& candidate) {
    const int i = candidate.from, j = candidate.to;
    const Vector3f &point = candidate.point, &other = to_.points[j];
    if (other.z() == 0) return;
    // A point behind what the target saw is hidden there and says nothing.
    if (point.z() > other.z() + along_ray_) return;
    ++sum_.visible;
    sum_.cost += 1;
    if (!to_.has_normal(j)) return;
    const float residual = to_.normals[j].dot(point - other);
    if (std::abs(residual) > reach_ || std::abs(point.z() - other.z()) > along_ray_) return;
    if (to_.normals[j].dot(turned(from_.normals[i])) < gate_.normal_cosine) return;
    const double variance = from_.sigma_m[i] * from_.sigma_m[i] + to_.sigma_m[j] * to_.sigma_m[j];
    const Tukey tukey(residual / gate_.distance_m);
    sum_.cost += tukey.loss - 1;
    if (tukey.weight == 0) return;
    const Vector3d normal = world_from_target_.linear() * to_.normals[j].cast<double>();
    const Vector3d world = world_from_target_ * point.cast<double>();
    Vector6d jacobian;
    jacobian << world.cross(normal), normal;
    const double weight = 1e-6 * tukey.weight / variance;  // of a residual in millimetres
    for (int c = 0; c < 6; ++c) {
      const double scaled = weight * jacobian[c];
      for (int r = c; r < 6; ++r) sum_.matrix(r, c) += scaled * jacobian[r];
    }
    sum_.vector -= weight * residual * jacobian;
    sum_.squared_residual_m2 += residual * residual;
    ++sum_.inliers;
  }

  PairEquations equations() const {
    PairEquations result = sum_;
    result.matrix = Matrix6d(sum_.matrix.selfadjointView<Eigen::Lower>());
    return result;
  }

 private:
  // Written out: Eigen calls a function of its own for a product of this size.
  Vector3f turned(const Vector3f& v) const {
    return rotation_.col(0) * v.x() + rotation_.col(1) * v.y() + rotation_.col(2) * v.z();
  }

  const DepthMap &from_, &to_;
  const Eigen::Matrix3f rotation_;
  const Vector3f translation_;
  const Isometry3d& world_from_target_;
  const CorrespondenceRejector& gate_;
  const float reach_, along_ray_;  // an oblique surface is that much farther along the ray than off its plane
  PairEquations sum_;
};

}  // namespace

Vector6d solve_twist(Matrix6d matrix, const Vector6d& vector) {
  constexpr double kDamping = 1e-9;  // keeps what no point holds where it is, and moves nothing else
  matrix.diagonal().array() += kDamping * matrix.trace();
  return solve_symmetric(matrix, vector);
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

Vector6d motion_at(const Isometry3d& motion, const Vector3d& centre) {
  const Eigen::AngleAxisd turn(motion.linear());
  Vector6d step;
  step << turn.angle() * turn.axis(), motion * centre - centre;
  return step;
}

Isometry3d motion_about(const Vector6d& step, const Vector3d& centre) {
  Isometry3d motion = Isometry3d::Identity();
  if (const double angle = step.head<3>().norm(); angle > 0)
    motion.linear() = Eigen::AngleAxisd(angle, step.head<3>() / angle).toRotationMatrix();
  motion.translation() = centre + step.tail<3>() - motion.linear() * centre;
  return motion;
}

PairEquations pair_equations(const DepthMap& from, const std::vector<int>& samples, const DepthMap& to,
                             const Projector& projector, const Isometry3d& world_from_source,
                             const Isometry3d& world_from_target, const CorrespondenceRejector& gate) {
  Pairing pairing(from, to, world_from_target.inverse() * world_from_source, world_from_target, gate);
  std::array<Candidate, kBlock> block;
  for (std::size_t k = 0; k < samples.size();) {
    int count = 0;
    for (; k < samples.size() && count < kBlock; k += gate.stride) {
      if (k + kAhead * gate.stride < samples.size())
        __builtin_prefetch(&from.points[samples[k + kAhead * gate.stride]]);
      if (pairing.find(samples[k], projector, block[count])) ++count;
    }
    for (int c = 0; c < count; ++c) pairing.add(block[c]);
  }
  return pairing.equations();
}

}  // namespace dressform
