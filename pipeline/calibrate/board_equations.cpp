#include "pipeline/calibrate/board_equations.h"

#include <tbb/parallel_for.h>

#include <cmath>

namespace dressform::board_equations {
namespace {

constexpr double huber = 3;               // in sigmas
constexpr double single_depth_m = 0.004;  // scatter of one square's depth, for Huber only
constexpr double nearest_m = 0.01;        // of a corner before a camera: an adjustment under way may put it behind
constexpr double least_facing = 0.05;     // cosine of a board to a ray: where it is seen from the side it has no depth
// Sigmas of what boards may leave open, in parts of the image's width: fx - fy, and the principal point off the middle.
constexpr double usual_aspect = 0.02, usual_center = 0.05;
constexpr double usual_distortion[] = {0.3, 0.6, 0.01, 0.01, 0.6};  // k1, k2, p1, p2, k3
constexpr double usual_offset_m = 0.03;                             // Kinects: 10 to 25 mm

// Weight of a residual whose size in sigmas is known, and its cost (Huber, 1964): linear beyond the limit.
double huber_weight(double sigmas) { return sigmas <= huber ? 1 : huber / sigmas; }
double huber_cost(double sigmas) { return sigmas <= huber ? sigmas * sigmas : huber * (2 * sigmas - huber); }

void add_corners(const BoardGrid& grid, const std::vector<Vector2d>& corners, const Camera& camera,
                 const Isometry3d& ir_from_board, const Isometry3d* color_from_ir, double sigma_px,
                 ViewEquations& out) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3d in_ir = ir_from_board * grid.point(static_cast<int>(i));
    const Vector3d point = color_from_ir ? *color_from_ir * in_ir : in_ir;
    if (point.z() < nearest_m) continue;
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
    jacobian.middleCols<3>(pose_at) = -by_ir_point * cross_matrix(in_ir);
    jacobian.middleCols<3>(pose_at + 3) = by_ir_point;
    const Vector2d residual = projection.pixel - corners[i];
    const double sigmas = residual.norm() / sigma_px;
    const double weight = huber_weight(sigmas) / (sigma_px * sigma_px);
    out.cost += huber_cost(sigmas);
    for (int k = 0; k < 2; ++k) out.add(residual[k], jacobian.row(k).transpose(), weight);
  }
}

// Depth of the board's plane n.p = n.t along the pixel's ray r is n.t / n.r. All squares of a board together weigh as
// much as one measurement of depth_sigma_m: their errors are not independent.
void add_depth(const AdjustOptions& options, const std::vector<BoardDepth>& samples, const SensorCalibration& sensor,
               const Isometry3d& ir_from_board, ViewEquations& out) {
  const Vector3d normal = ir_from_board.linear().col(2), origin = ir_from_board.translation();
  const double share = 1 / (options.depth_sigma_m * options.depth_sigma_m * samples.size());
  for (const auto& sample : samples) {
    const Vector2d ideal = sensor.ir.normalized(sample.pixel);
    const Vector3d ray(ideal.x(), ideal.y(), 1);
    const double along = normal.dot(ray);
    if (std::abs(along) < least_facing) continue;
    const double plane_m = normal.dot(origin) / along;
    const double residual = plane_m + sensor.depth_offset_m - sample.depth_m;
    const Projection projection = project_ideal(sensor.ir, ideal);
    Vector gradient = Vector::Zero();
    // The pixel stays where it is: another camera sees it along another ray.
    const Eigen::Matrix<double, 2, 9> ideal_by_camera = -projection.by_ideal.inverse() * projection.by_camera;
    gradient.segment<9>(ir_at) = -plane_m / along * ideal_by_camera.transpose() * normal.head<2>();
    gradient[offset_at] = 1;
    gradient.segment<3>(pose_at) = -plane_m / along * normal.cross(ray);
    gradient.segment<3>(pose_at + 3) = normal / along;
    const double sigmas = std::abs(residual) / single_depth_m;
    const double weight = share * huber_weight(sigmas);
    out.cost += share * single_depth_m * single_depth_m * huber_cost(sigmas);
    out.add(residual, gradient, weight);
  }
}

void add_prior(const Camera& camera, int at, ViewEquations& out) {
  const auto one = [&](double residual, int index, double sigma, int other = -1) {
    Vector gradient = Vector::Zero();
    gradient[at + index] = 1;
    if (other >= 0) gradient[at + other] = -1;
    out.cost += residual * residual / (sigma * sigma);
    out.add(residual, gradient, 1 / (sigma * sigma));
  };
  one(camera.fx - camera.fy, 0, usual_aspect * camera.width, 1);
  one(camera.cx - 0.5 * (camera.width - 1), 2, usual_center * camera.width);
  one(camera.cy - 0.5 * (camera.height - 1), 3, usual_center * camera.width);
  for (int i = 0; i < 5; ++i) one(camera.distortion[i], 4 + i, usual_distortion[i]);
}

}  // namespace

std::vector<ViewEquations> view_equations(const SensorBoards& boards, const AdjustOptions& options,
                                          const CornerSigmas& sigmas, const BoardSolution& at) {
  std::vector<ViewEquations> result(boards.views.size());
  tbb::parallel_for(std::size_t(0), result.size(), [&](std::size_t i) {
    const BoardView& view = boards.views[i];
    const Isometry3d& pose = at.ir_from_board[i];
    add_corners(boards.grid, view.ir, at.sensor.ir, pose, nullptr, sigmas.ir_px, result[i]);
    if (options.use_color && at.sensor.color)
      add_corners(boards.grid, view.color, *at.sensor.color, pose, &at.sensor.color_from_ir, sigmas.color_px,
                  result[i]);
    if (options.use_depth) add_depth(options, view.depth, at.sensor, pose, result[i]);
  });
  return result;
}

ViewEquations prior_equations(const AdjustOptions& options, const BoardSolution& at) {
  ViewEquations result;
  if (options.fit_offset && options.use_depth) {
    Vector gradient = Vector::Zero();
    gradient[offset_at] = 1;
    const double weight = 1 / (usual_offset_m * usual_offset_m);
    result.cost += weight * at.sensor.depth_offset_m * at.sensor.depth_offset_m;
    result.add(at.sensor.depth_offset_m, gradient, weight);
  }
  if (!options.fit_cameras) return result;
  add_prior(at.sensor.ir, ir_at, result);
  if (at.sensor.color) add_prior(*at.sensor.color, color_at, result);
  return result;
}

std::array<bool, shared> moving_unknowns(const AdjustOptions& options, const BoardSolution& at) {
  std::array<bool, shared> result{};
  for (int i = 0; i < 9; ++i) {
    result[ir_at + i] = options.fit_cameras;
    result[color_at + i] = options.fit_cameras && options.use_color && at.sensor.color;
    if (i < 6) result[step_at + i] = options.fit_step && options.use_color && at.sensor.color;
  }
  result[offset_at] = options.fit_offset && options.use_depth;
  return result;
}

}  // namespace dressform::board_equations
