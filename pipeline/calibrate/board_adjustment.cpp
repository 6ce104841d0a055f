#include "pipeline/calibrate/board_adjustment.h"

#include <algorithm>
#include <cmath>

#include "pipeline/calibrate/board_equations.h"

namespace dressform {
namespace board_equations {
namespace {

constexpr double least_sigma_px = 0.02;  // a perfect image is not trusted without end
constexpr int rounds = 3;                // of weighting the cameras by their own scatter: it settles in two
// Levenberg-Marquardt: damping starts and ends at, and never falls below; a gain so small, in parts, is none.
constexpr double first_damping = 1e-3, last_damping = 1e8, least_damping = 1e-12, small_gain = 1e-10;
constexpr double shortest = 0.1, longest = 20;  // focal lengths in image widths: a step beyond went astray
constexpr double pose_damping = 1e-9;           // of a pose that no corner holds

using SharedMatrix = Eigen::Matrix<double, shared, shared>;
using SharedVector = Eigen::Matrix<double, shared, 1>;
using PoseMatrix = Eigen::Matrix<double, 6, 6>;
using PoseVector = Eigen::Matrix<double, 6, 1>;

double total_cost(const std::vector<ViewEquations>& views, const ViewEquations& priors) {
  double cost = priors.cost;
  for (const auto& view : views) cost += view.cost;
  return cost;
}

struct Step {
  SharedVector shared_part = SharedVector::Zero();
  std::vector<PoseVector> poses;
  SharedMatrix covariance;
};

// Damped normal equations, poses eliminated.
Step solve(const std::vector<ViewEquations>& views, const ViewEquations& priors, const std::array<bool, shared>& moving,
           double damping) {
  SharedMatrix matrix = priors.matrix.topLeftCorner<shared, shared>().selfadjointView<Eigen::Lower>();
  SharedVector right = priors.right.head<shared>();
  for (const auto& view : views) {
    matrix += SharedMatrix(view.matrix.topLeftCorner<shared, shared>().selfadjointView<Eigen::Lower>());
    right += view.right.head<shared>();
  }
  matrix.diagonal() *= 1 + damping;
  std::vector<PoseMatrix> inverses(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    PoseMatrix pose = views[i].matrix.bottomRightCorner<6, 6>().selfadjointView<Eigen::Lower>();
    pose.diagonal() *= 1 + damping;
    pose.diagonal().array() += pose_damping;
    inverses[i] = pose.inverse();
    const auto cross = views[i].matrix.bottomLeftCorner<6, shared>();
    matrix -= cross.transpose() * inverses[i] * cross;
    right -= cross.transpose() * (inverses[i] * views[i].right.tail<6>());
  }
  for (int i = 0; i < shared; ++i)
    if (!moving[i]) {
      matrix.row(i).setZero(), matrix.col(i).setZero();
      matrix(i, i) = 1, right[i] = 0;
    }
  Step step;
  // Unknowns differ by orders of magnitude: scaled to a unit diagonal first.
  const SharedVector scale = matrix.diagonal().cwiseMax(1e-30).cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<SharedMatrix> factors(scale.asDiagonal() * matrix * scale.asDiagonal());
  step.shared_part = scale.asDiagonal() * factors.solve(scale.asDiagonal() * right);
  step.covariance = scale.asDiagonal() * factors.solve(SharedMatrix::Identity()) * scale.asDiagonal();
  for (std::size_t i = 0; i < views.size(); ++i)
    step.poses.push_back(inverses[i] *
                         (views[i].right.tail<6>() - views[i].matrix.bottomLeftCorner<6, shared>() * step.shared_part));
  return step;
}

BoardSolution stepped(const BoardSolution& from, const Step& step) {
  BoardSolution to = from;
  const auto& s = step.shared_part;
  to.sensor.ir = camera_with(from.sensor.ir, camera_vector(from.sensor.ir) + s.segment<9>(ir_at));
  if (from.sensor.color)
    to.sensor.color = camera_with(*from.sensor.color, camera_vector(*from.sensor.color) + s.segment<9>(color_at));
  to.sensor.color_from_ir = moved(from.sensor.color_from_ir, s.segment<6>(step_at));
  to.sensor.depth_offset_m += s[offset_at];
  for (std::size_t i = 0; i < step.poses.size(); ++i) to.ir_from_board[i] = moved(from.ir_from_board[i], step.poses[i]);
  return to;
}

bool sensible(const Camera& camera) {
  const auto possible = [&](double focal) { return focal > shortest * camera.width && focal < longest * camera.width; };
  return possible(camera.fx) && possible(camera.fy);
}

// One Levenberg-Marquardt run with fixed weights.
BoardSolution run(const SensorBoards& boards, BoardSolution at, const AdjustOptions& options,
                  const CornerSigmas& sigmas) {
  const auto moving = moving_unknowns(options, at);
  auto views = view_equations(boards, options, sigmas, at);
  auto priors = prior_equations(options, at);
  double cost = total_cost(views, priors), damping = first_damping;
  at.converged = false;
  for (at.iterations = 0; at.iterations < options.max_iterations && !at.converged; ++at.iterations) {
    const Step step = solve(views, priors, moving, damping);
    const BoardSolution next = stepped(at, step);
    if (!step.shared_part.allFinite() || !sensible(next.sensor.ir) ||
        (next.sensor.color && !sensible(*next.sensor.color))) {
      damping *= 10;
      continue;
    }
    auto next_views = view_equations(boards, options, sigmas, next);
    auto next_priors = prior_equations(options, next);
    const double next_cost = total_cost(next_views, next_priors);
    if (!(next_cost <= cost)) {
      at.converged = damping > last_damping;  // no direction leads further down
      damping *= 8;
      continue;
    }
    const int done = at.iterations;
    const bool small = cost - next_cost < small_gain * (1 + cost);
    at = next;
    at.iterations = done;
    at.converged = small;
    views = std::move(next_views), priors = next_priors, cost = next_cost;
    damping = std::max(least_damping, damping / 6);
  }
  const SharedMatrix covariance = solve(views, priors, moving, 0).covariance;
  at.ir_focal_sigma = moving[ir_at] ? std::sqrt(std::max(0.0, covariance(ir_at, ir_at))) / at.sensor.ir.fx : 0;
  at.color_focal_sigma =
      moving[color_at] ? std::sqrt(std::max(0.0, covariance(color_at, color_at))) / at.sensor.color->fx : 0;
  return at;
}

double root_mean_square(const std::vector<ViewResidual>& views, double ViewResidual::*value) {
  double sum = 0;
  int count = 0;
  for (const auto& view : views)
    if (std::isfinite(view.*value)) sum += view.*value * view.*value, ++count;
  return count ? std::sqrt(sum / count) : 0;
}

}  // namespace
}  // namespace board_equations

BoardSolution adjust_boards(const SensorBoards& boards, const BoardSolution& start, const AdjustOptions& options) {
  BoardSolution solution = start;
  using namespace board_equations;
  CornerSigmas sigmas;  // the first run only comes near; then each camera by its own scatter
  for (int round = 0; round < rounds; ++round) {
    solution = run(boards, solution, options, sigmas);
    const auto residuals = view_residuals(boards, solution);
    solution.ir_rms_px = root_mean_square(residuals, &ViewResidual::ir_px);
    solution.color_rms_px = root_mean_square(residuals, &ViewResidual::color_px);
    sigmas.ir_px = std::max(least_sigma_px, solution.ir_rms_px / M_SQRT2);
    sigmas.color_px = std::max(least_sigma_px, solution.color_rms_px / M_SQRT2);
  }
  return solution;
}

}  // namespace dressform
