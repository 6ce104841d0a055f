#include "pipeline/calibrate/board_adjustment.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include "pipeline/calibrate/projection.h"

namespace dressform {
namespace {

// Shared unknowns: infrared camera, colour camera, step from infrared to colour, depth offset.
constexpr int ir_at = 0, color_at = 9, step_at = 18, offset_at = 24, shared = 25;
constexpr double huber = 3;               // in sigmas
constexpr double least_sigma_px = 0.02;   // a perfect image is not trusted without end
constexpr double usual_offset_m = 0.03;   // Kinects: 10 to 25 mm
constexpr double single_depth_m = 0.004;  // scatter of one square's depth, for Huber only

using SharedMatrix = Eigen::Matrix<double, shared, shared>;
using SharedVector = Eigen::Matrix<double, shared, 1>;
using PoseMatrix = Eigen::Matrix<double, 6, 6>;
using PoseVector = Eigen::Matrix<double, 6, 1>;

// Normal equations of one view, with its pose last.
struct ViewEquations {
  Eigen::Matrix<double, shared + 6, shared + 6> matrix;
  Eigen::Matrix<double, shared + 6, 1> right;
  double cost = 0;

  ViewEquations() { matrix.setZero(), right.setZero(); }

  // One scalar residual with its gradient; scaled by 1 / sigma; beyond `limit` linear.
  void add(double residual, const Eigen::Matrix<double, shared + 6, 1>& gradient, double weight) {
    matrix.selfadjointView<Eigen::Lower>().rankUpdate(gradient, weight);
    right -= weight * residual * gradient;
  }
};

// Weight of a residual whose size in sigmas is known, and its cost.
double huber_weight(double sigmas) { return sigmas <= huber ? 1 : huber / sigmas; }
double huber_cost(double sigmas) { return sigmas <= huber ? sigmas * sigmas : huber * (2 * sigmas - huber); }

class Adjustment {
 public:
  Adjustment(const SensorBoards& boards, const AdjustOptions& options, double ir_sigma_px, double color_sigma_px)
      : boards_(boards), options_(options), ir_sigma_px_(ir_sigma_px), color_sigma_px_(color_sigma_px) {}

  std::vector<ViewEquations> equations(const BoardSolution& at) const {
    std::vector<ViewEquations> result(boards_.views.size());
    tbb::parallel_for(std::size_t(0), result.size(), [&](std::size_t i) {
      const BoardView& view = boards_.views[i];
      const Isometry3d& pose = at.ir_from_board[i];
      add_corners(view.ir, at.sensor.ir, pose, nullptr, ir_sigma_px_, result[i]);
      if (options_.use_color && at.sensor.color)
        add_corners(view.color, *at.sensor.color, pose, &at.sensor.color_from_ir, color_sigma_px_, result[i]);
      if (options_.use_depth) add_depth(view.depth, at.sensor, pose, result[i]);
    });
    return result;
  }

  // The priors, as equations without a pose.
  ViewEquations priors(const BoardSolution& at) const {
    ViewEquations result;
    if (options_.fit_offset && options_.use_depth) {
      Eigen::Matrix<double, shared + 6, 1> gradient = Eigen::Matrix<double, shared + 6, 1>::Zero();
      gradient[offset_at] = 1;
      const double weight = 1 / (usual_offset_m * usual_offset_m);
      result.cost += weight * at.sensor.depth_offset_m * at.sensor.depth_offset_m;
      result.add(at.sensor.depth_offset_m, gradient, weight);
    }
    if (!options_.fit_cameras) return result;
    add_prior(at.sensor.ir, ir_at, result);
    if (at.sensor.color) add_prior(*at.sensor.color, color_at, result);
    return result;
  }

  // Which of the shared unknowns move.
  std::array<bool, shared> moving(const BoardSolution& at) const {
    std::array<bool, shared> result{};
    for (int i = 0; i < 9; ++i) {
      result[ir_at + i] = options_.fit_cameras;
      result[color_at + i] = options_.fit_cameras && options_.use_color && at.sensor.color;
      if (i < 6) result[step_at + i] = options_.fit_step && options_.use_color && at.sensor.color;
    }
    result[offset_at] = options_.fit_offset && options_.use_depth;
    return result;
  }

 private:
  void add_corners(const std::vector<Vector2d>& corners, const Camera& camera, const Isometry3d& ir_from_board,
                   const Isometry3d* color_from_ir, double sigma_px, ViewEquations& out) const {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector3d in_ir = ir_from_board * boards_.grid.point(static_cast<int>(i));
      const Vector3d point = color_from_ir ? *color_from_ir * in_ir : in_ir;
      if (point.z() < 0.01) continue;
      const Projection projection = project_ideal(camera, point.head<2>() / point.z());
      const Eigen::Matrix<double, 2, 3> by_point = projection.by_ideal * ideal_by_point(point);
      Eigen::Matrix<double, 2, shared + 6> jacobian = Eigen::Matrix<double, 2, shared + 6>::Zero();
      jacobian.middleCols<9>(color_from_ir ? color_at : ir_at) = projection.by_camera;
      Eigen::Matrix<double, 2, 3> by_ir_point = by_point;
      if (color_from_ir) {
        jacobian.middleCols<3>(step_at) = -by_point * cross_matrix(point);
        jacobian.middleCols<3>(step_at + 3) = by_point;
        by_ir_point = by_point * color_from_ir->linear();
      }
      jacobian.middleCols<3>(shared) = -by_ir_point * cross_matrix(in_ir);
      jacobian.middleCols<3>(shared + 3) = by_ir_point;
      const Vector2d residual = projection.pixel - corners[i];
      const double sigmas = residual.norm() / sigma_px;
      const double weight = huber_weight(sigmas) / (sigma_px * sigma_px);
      out.cost += huber_cost(sigmas);
      for (int k = 0; k < 2; ++k) out.add(residual[k], jacobian.row(k).transpose(), weight);
    }
  }

  // Depth of the board's plane n.p = n.t along the pixel's ray r is n.t / n.r. All squares of a board together weigh as
  // much as one measurement of depth_sigma_m: their errors are not independent.
  void add_depth(const std::vector<BoardDepth>& samples, const SensorCalibration& sensor,
                 const Isometry3d& ir_from_board, ViewEquations& out) const {
    const Vector3d normal = ir_from_board.linear().col(2), origin = ir_from_board.translation();
    const double share = 1 / (options_.depth_sigma_m * options_.depth_sigma_m * samples.size());
    for (const auto& sample : samples) {
      const Vector2d ideal = sensor.ir.normalized(sample.pixel);
      const Vector3d ray(ideal.x(), ideal.y(), 1);
      const double along = normal.dot(ray);
      if (std::abs(along) < 0.05) continue;
      const double plane_m = normal.dot(origin) / along;
      const double residual = plane_m + sensor.depth_offset_m - sample.depth_m;
      const Projection projection = project_ideal(sensor.ir, ideal);
      Eigen::Matrix<double, shared + 6, 1> gradient = Eigen::Matrix<double, shared + 6, 1>::Zero();
      // The pixel stays where it is: another camera sees it along another ray.
      const Eigen::Matrix<double, 2, 9> ideal_by_camera = -projection.by_ideal.inverse() * projection.by_camera;
      gradient.segment<9>(ir_at) = -plane_m / along * ideal_by_camera.transpose() * normal.head<2>();
      gradient[offset_at] = 1;
      gradient.segment<3>(shared) = -plane_m / along * normal.cross(ray);
      gradient.segment<3>(shared + 3) = normal / along;
      const double sigmas = std::abs(residual) / single_depth_m;
      const double weight = share * huber_weight(sigmas);
      out.cost += share * single_depth_m * single_depth_m * huber_cost(sigmas);
      out.add(residual, gradient, weight);
    }
  }

  static void add_prior(const Camera& camera, int at, ViewEquations& out) {
    const auto one = [&](double residual, int index, double sigma, int other = -1) {
      Eigen::Matrix<double, shared + 6, 1> gradient = Eigen::Matrix<double, shared + 6, 1>::Zero();
      gradient[at + index] = 1;
      if (other >= 0) gradient[at + other] = -1;
      out.cost += residual * residual / (sigma * sigma);
      out.add(residual, gradient, 1 / (sigma * sigma));
    };
    one(camera.fx - camera.fy, 0, 0.02 * camera.width, 1);
    one(camera.cx - 0.5 * (camera.width - 1), 2, 0.05 * camera.width);
    one(camera.cy - 0.5 * (camera.height - 1), 3, 0.05 * camera.width);
    const double usual[] = {0.3, 0.6, 0.01, 0.01, 0.6};
    for (int i = 0; i < 5; ++i) one(camera.distortion[i], 4 + i, usual[i]);
  }

  const SensorBoards& boards_;
  const AdjustOptions& options_;
  double ir_sigma_px_, color_sigma_px_;
};

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
    pose.diagonal().array() += 1e-9;
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
  return camera.fx > 0.1 * camera.width && camera.fy > 0.1 * camera.width && camera.fx < 20 * camera.width &&
         camera.fy < 20 * camera.width;
}

// One Levenberg-Marquardt run with fixed weights.
BoardSolution run(const SensorBoards& boards, BoardSolution at, const AdjustOptions& options, double ir_sigma_px,
                  double color_sigma_px) {
  const Adjustment adjustment(boards, options, ir_sigma_px, color_sigma_px);
  const auto moving = adjustment.moving(at);
  auto views = adjustment.equations(at);
  auto priors = adjustment.priors(at);
  double cost = total_cost(views, priors), damping = 1e-3;
  at.converged = false;
  for (at.iterations = 0; at.iterations < options.max_iterations && !at.converged; ++at.iterations) {
    const Step step = solve(views, priors, moving, damping);
    const BoardSolution next = stepped(at, step);
    if (!step.shared_part.allFinite() || !sensible(next.sensor.ir) ||
        (next.sensor.color && !sensible(*next.sensor.color))) {
      damping *= 10;
      continue;
    }
    auto next_views = adjustment.equations(next);
    auto next_priors = adjustment.priors(next);
    const double next_cost = total_cost(next_views, next_priors);
    if (!(next_cost <= cost)) {
      at.converged = damping > 1e8;  // no direction leads further down
      damping *= 8;
      continue;
    }
    const int done = at.iterations;
    const bool small = cost - next_cost < 1e-10 * (1 + cost);
    at = next;
    at.iterations = done;
    at.converged = small;
    views = std::move(next_views), priors = next_priors, cost = next_cost;
    damping = std::max(1e-12, damping / 6);
  }
  const SharedMatrix covariance = solve(views, priors, moving, 0).covariance;
  at.ir_focal_sigma = moving[ir_at] ? std::sqrt(std::max(0.0, covariance(ir_at, ir_at))) / at.sensor.ir.fx : 0;
  at.color_focal_sigma =
      moving[color_at] ? std::sqrt(std::max(0.0, covariance(color_at, color_at))) / at.sensor.color->fx : 0;
  return at;
}

double rms_distance(const std::vector<Vector2d>& corners, const Camera& camera, const Isometry3d& camera_from_board,
                    const BoardGrid& grid) {
  if (corners.empty()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3d point = camera_from_board * grid.point(static_cast<int>(i));
    sum += (project_ideal(camera, point.head<2>() / point.z()).pixel - corners[i]).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(corners.size()));
}

double root_mean_square(const std::vector<ViewResidual>& views, double ViewResidual::*value) {
  double sum = 0;
  int count = 0;
  for (const auto& view : views)
    if (std::isfinite(view.*value)) sum += view.*value * view.*value, ++count;
  return count ? std::sqrt(sum / count) : 0;
}

}  // namespace

std::vector<ViewResidual> view_residuals(const SensorBoards& boards, const BoardSolution& solution) {
  std::vector<ViewResidual> result;
  for (std::size_t i = 0; i < boards.views.size(); ++i) {
    const BoardView& view = boards.views[i];
    const Isometry3d& pose = solution.ir_from_board[i];
    ViewResidual residual;
    residual.ir_px = rms_distance(view.ir, solution.sensor.ir, pose, boards.grid);
    residual.color_px = std::numeric_limits<double>::quiet_NaN();
    if (solution.sensor.color)
      residual.color_px =
          rms_distance(view.color, *solution.sensor.color, solution.sensor.color_from_ir * pose, boards.grid);
    std::vector<double> differences;
    const Vector3d normal = pose.linear().col(2);
    for (const auto& sample : view.depth) {
      const Vector2d ideal = solution.sensor.ir.normalized(sample.pixel);
      const double plane_m = normal.dot(pose.translation()) / normal.dot(Vector3d(ideal.x(), ideal.y(), 1));
      differences.push_back(sample.depth_m - solution.sensor.depth_offset_m - plane_m);
    }
    residual.depth_m = residual.distance_m = std::numeric_limits<double>::quiet_NaN();
    if (differences.size() >= 8) {  // the middle half's mean: single squares may be beside the board
      std::sort(differences.begin(), differences.end());
      const std::size_t quarter = differences.size() / 4;
      double sum = 0;
      for (std::size_t k = quarter; k < differences.size() - quarter; ++k) sum += differences[k];
      residual.depth_m = sum / static_cast<double>(differences.size() - 2 * quarter);
      const int last = boards.grid.count() - 1;
      residual.distance_m = (pose * Vector3d(0.5 * boards.grid.point(last))).z();
    }
    result.push_back(residual);
  }
  return result;
}

std::vector<Isometry3d> start_poses(const SensorBoards& boards, const SensorCalibration& sensor) {
  std::vector<Isometry3d> poses;
  for (const auto& view : boards.views) {
    if (!view.ir.empty() || !sensor.color)
      poses.push_back(board_pose(sensor.ir, view.ir, boards.grid));
    else
      poses.push_back(sensor.color_from_ir.inverse() * board_pose(*sensor.color, view.color, boards.grid));
  }
  return poses;
}

BoardSolution adjust_boards(const SensorBoards& boards, const BoardSolution& start, const AdjustOptions& options) {
  BoardSolution solution = start;
  double ir_sigma_px = 1, color_sigma_px = 1;  // the first run only comes near; then each camera by its own scatter
  for (int round = 0; round < 3; ++round) {
    solution = run(boards, solution, options, ir_sigma_px, color_sigma_px);
    const auto residuals = view_residuals(boards, solution);
    solution.ir_rms_px = root_mean_square(residuals, &ViewResidual::ir_px);
    solution.color_rms_px = root_mean_square(residuals, &ViewResidual::color_px);
    ir_sigma_px = std::max(least_sigma_px, solution.ir_rms_px / M_SQRT2);
    color_sigma_px = std::max(least_sigma_px, solution.color_rms_px / M_SQRT2);
  }
  return solution;
}

}  // namespace dressform
