#include "pipeline/fuse/align_frames.h"

#include <tbb/parallel_for.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

constexpr int kLeastInliers = 60;                     // for six unknowns with much to spare
constexpr double kStill_rad = 2e-5, kStill_m = 5e-5;  // steps that move no point of a body by a tenth of a millimetre
constexpr double kAnchor = 1e6;    // weight of the frame that the others are measured from, over its own equations
constexpr double kDamping = 1e-9;  // the same for all others: keeps what no pair holds where it is

}  // namespace

FrameAlignment align_to_maps(const DepthMap& map, const std::vector<int>& samples, const Projector& projector,
                             const std::vector<FixedMap>& targets, const Isometry3d& initial,
                             const std::vector<CorrespondenceRejector>& gates, int iterations) {
  FrameAlignment result;
  result.world_from_frame = initial;
  for (const CorrespondenceRejector& gate : gates)
    for (int iteration = 0; iteration < iterations; ++iteration) {
      PairEquations sum;
      for (const FixedMap& target : targets) {
        const PairEquations pair =
            pair_equations(map, samples, target.map, projector, result.world_from_frame, target.world_from_map, gate);
        sum.matrix += pair.matrix;
        sum.vector += pair.vector;
        sum.squared_residual_m2 += pair.squared_residual_m2;
        sum.cost += pair.cost;
        sum.inliers += pair.inliers;
        sum.visible += pair.visible;
      }
      if (sum.inliers < kLeastInliers) return result.converged = false, result;
      const Vector6d twist = solve_twist(sum.matrix, sum.vector);
      result.world_from_frame = exponential(twist) * result.world_from_frame;
      result.residual_rms_m = std::sqrt(sum.squared_residual_m2 / sum.inliers);
      result.inlier_part = static_cast<double>(sum.inliers) / sum.visible;
      result.cost = sum.cost / sum.visible;
      result.converged = true;
      if (negligible(twist, kStill_rad, kStill_m)) break;
    }
  return result;
}

FrameAlignment align_to_frames(const ScanFrames& frames, const Projector& projector, int frame,
                               const std::vector<int>& targets, const std::vector<Isometry3d>& world_from_frame,
                               const Isometry3d& initial, const std::vector<CorrespondenceRejector>& gates,
                               int iterations) {
  std::vector<FixedMap> fixed;
  for (const int target : targets) fixed.push_back({frames.maps[target], world_from_frame[target]});
  return align_to_maps(frames.maps[frame], frames.samples[frame], projector, fixed, initial, gates, iterations);
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
    const double anchor = i == fixed || diagonal[i].trace() == 0 ? kAnchor * scale : kDamping * scale;
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
                          const std::vector<CorrespondenceRejector>& gates, int iterations) {
  std::vector<std::pair<int, int>> pairs;
  for (const auto& [a, b] : undirected) {
    pairs.emplace_back(a, b);
    pairs.emplace_back(b, a);
  }
  GlobalAlignment result;
  for (const CorrespondenceRejector& gate : gates)
    for (int iteration = 0; iteration < iterations; ++iteration) {
      std::vector<PairEquations> equations(pairs.size());
      tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t k) {
        const auto [source, target] = pairs[k];
        equations[k] = pair_equations(frames.maps[source], frames.samples[source], frames.maps[target], projector,
                                      world_from_frame[source], world_from_frame[target], gate);
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
      if (largest < kStill_m) break;
    }
  result.world_from_frame = std::move(world_from_frame);
  return result;
}

}  // namespace dressform
