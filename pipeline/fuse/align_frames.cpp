#include "pipeline/fuse/align_frames.h"

#include <tbb/parallel_for.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

// Tukey's biweight: weight and loss of a residual in units of the constant; the loss saturates at 1.
struct Tukey {
  double weight, loss;
  explicit Tukey(double ratio) {
    const double u = std::max(0.0, 1 - ratio * ratio);
    weight = u * u;
    loss = 1 - u * u * u;
  }
};

Vector6d solve_regularised(Matrix6d matrix, const Vector6d& vector) {
  matrix.diagonal().array() += 1e-9 * matrix.trace();
  return matrix.ldlt().solve(vector);
}

constexpr int kLeastInliers = 60;

}  // namespace

Isometry3d exponential(const Vector6d& twist) {
  Isometry3d result = Isometry3d::Identity();
  const double angle = twist.head<3>().norm();
  if (angle > 1e-12) result.linear() = Eigen::AngleAxisd(angle, twist.head<3>() / angle).toRotationMatrix();
  result.translation() = twist.tail<3>();
  return result;
}

PairEquations pair_equations(const ScanFrames& frames, const Projector& projector, int source, int target,
                             const Isometry3d& world_from_source, const Isometry3d& world_from_target,
                             const PairGate& gate) {
  const DepthMap &from = frames.maps[source], &to = frames.maps[target];
  const Isometry3d target_from_source = world_from_target.inverse() * world_from_source;
  const Eigen::Matrix3f rotation = target_from_source.linear().cast<float>();
  const Vector3f translation = target_from_source.translation().cast<float>();
  const auto reach = static_cast<float>(1.5 * gate.distance_m);
  PairEquations result;
  const auto& samples = frames.samples[source];
  for (std::size_t k = 0; k < samples.size(); k += gate.stride) {
    const int i = samples[k];
    const Vector3f point = rotation * from.points[i] + translation;
    Vector2f pixel;
    if (!projector(point, pixel)) continue;
    const int j = static_cast<int>(pixel.y() + 0.5f) * to.camera.width + static_cast<int>(pixel.x() + 0.5f);
    if (to.points[j].z() == 0) continue;
    // A point behind what the target saw is hidden there and says nothing.
    if (point.z() > to.points[j].z() + 3 * reach) continue;
    ++result.visible;
    result.cost += 1;
    if (!to.has_normal(j)) continue;
    const float residual = to.normals[j].dot(point - to.points[j]);
    if (std::abs(residual) > reach || std::abs(point.z() - to.points[j].z()) > 3 * reach) continue;
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

FrameAlignment align_to_frames(const ScanFrames& frames, const Projector& projector, int frame,
                               const std::vector<int>& targets, const std::vector<Isometry3d>& world_from_frame,
                               const Isometry3d& initial, const std::vector<PairGate>& gates, int iterations) {
  FrameAlignment result;
  result.world_from_frame = initial;
  for (const PairGate& gate : gates)
    for (int iteration = 0; iteration < iterations; ++iteration) {
      PairEquations sum;
      for (const int target : targets) {
        const PairEquations pair =
            pair_equations(frames, projector, frame, target, result.world_from_frame, world_from_frame[target], gate);
        sum.matrix += pair.matrix;
        sum.vector += pair.vector;
        sum.squared_residual_m2 += pair.squared_residual_m2;
        sum.cost += pair.cost;
        sum.inliers += pair.inliers;
        sum.visible += pair.visible;
      }
      if (sum.inliers < kLeastInliers) return result.converged = false, result;
      const Vector6d twist = solve_regularised(sum.matrix, sum.vector);
      result.world_from_frame = exponential(twist) * result.world_from_frame;
      result.residual_rms_m = std::sqrt(sum.squared_residual_m2 / sum.inliers);
      result.inlier_part = static_cast<double>(sum.inliers) / sum.visible;
      result.cost = sum.cost / sum.visible;
      result.converged = true;
      if (twist.head<3>().norm() < 2e-5 && twist.tail<3>().norm() < 5e-5) break;
    }
  return result;
}

namespace {

// Sparse normal equations of all poses, solved; one twist a frame. Frames without equations stay.
std::vector<Vector6d> solve_poses(int count, const std::vector<std::pair<int, int>>& pairs,
                                  const std::vector<PairEquations>& equations) {
  std::vector<Matrix6d> diagonal(count, Matrix6d::Zero());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(6 * count);
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int row, int column, const Matrix6d& block) {
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c) entries.emplace_back(6 * row + r, 6 * column + c, block(r, c));
  };
  int fixed = count;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [source, target] = pairs[k];
    const PairEquations& pair = equations[k];
    diagonal[source] += pair.matrix;
    diagonal[target] += pair.matrix;
    right.segment<6>(6 * source) += pair.vector;
    right.segment<6>(6 * target) -= pair.vector;
    add(std::max(source, target), std::min(source, target), -pair.matrix);
    if (pair.inliers > 0) fixed = std::min({fixed, source, target});
  }
  for (int i = 0; i < count; ++i) {
    const double scale = std::max(1.0, diagonal[i].trace());
    const double anchor = i == fixed || diagonal[i].trace() == 0 ? 1e6 * scale : 1e-9 * scale;
    add(i, i, diagonal[i] + anchor * Matrix6d::Identity());
  }
  Eigen::SparseMatrix<double> matrix(6 * count, 6 * count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  const Eigen::VectorXd solution = solver.solve(right);
  std::vector<Vector6d> twists(count, Vector6d::Zero());
  for (int i = 0; i < count; ++i)
    if (i != fixed) twists[i] = solution.segment<6>(6 * i);
  return twists;
}

}  // namespace

GlobalAlignment align_all(const ScanFrames& frames, const Projector& projector,
                          const std::vector<std::pair<int, int>>& undirected, std::vector<Isometry3d> world_from_frame,
                          const std::vector<PairGate>& gates, int iterations) {
  std::vector<std::pair<int, int>> pairs;
  for (const auto& [a, b] : undirected) {
    pairs.emplace_back(a, b);
    pairs.emplace_back(b, a);
  }
  GlobalAlignment result;
  for (const PairGate& gate : gates)
    for (int iteration = 0; iteration < iterations; ++iteration) {
      std::vector<PairEquations> equations(pairs.size());
      tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t k) {
        const auto [source, target] = pairs[k];
        equations[k] =
            pair_equations(frames, projector, source, target, world_from_frame[source], world_from_frame[target], gate);
      });
      const auto twists = solve_poses(frames.count(), pairs, equations);
      double largest = 0;
      for (int i = 0; i < frames.count(); ++i) {
        const Vector3d before = world_from_frame[i].translation();
        world_from_frame[i] = exponential(twists[i]) * world_from_frame[i];
        largest = std::max({largest, (world_from_frame[i].translation() - before).norm(), twists[i].head<3>().norm()});
      }
      double squares = 0;
      long long inliers = 0;
      for (const auto& each : equations) squares += each.squared_residual_m2, inliers += each.inliers;
      result.residual_rms_m = inliers ? std::sqrt(squares / inliers) : 0;
      result.last_step_m = largest;
      ++result.iterations;
      if (largest < 5e-5) break;
    }
  result.world_from_frame = std::move(world_from_frame);
  return result;
}

}  // namespace dressform
