#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/calibrate/board_adjustment.h"
#include "pipeline/calibrate/projection.h"

namespace dressform {
namespace {

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

// Mean of measured less offset less true depth over a board, metres; NaN where too little of it has depth. The middle
// half's mean: single squares may be beside the board.
double depth_difference_m(const BoardView& view, const SensorCalibration& sensor, const Isometry3d& ir_from_board) {
  if (!enough_depth(view)) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> differences;
  const Vector3d normal = ir_from_board.linear().col(2);
  for (const auto& sample : view.depth) {
    const Vector2d ideal = sensor.ir.normalized(sample.pixel);
    const double plane_m = normal.dot(ir_from_board.translation()) / normal.dot(Vector3d(ideal.x(), ideal.y(), 1));
    differences.push_back(sample.depth_m - sensor.depth_offset_m - plane_m);
  }
  std::sort(differences.begin(), differences.end());
  const std::size_t quarter = differences.size() / 4;
  double sum = 0;
  for (std::size_t k = quarter; k < differences.size() - quarter; ++k) sum += differences[k];
  return sum / static_cast<double>(differences.size() - 2 * quarter);
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
    residual.depth_m = depth_difference_m(view, solution.sensor, pose);
    residual.distance_m = std::numeric_limits<double>::quiet_NaN();
    if (std::isfinite(residual.depth_m))
      residual.distance_m = (pose * Vector3d(0.5 * boards.grid.point(boards.grid.count() - 1))).z();
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

}  // namespace dressform
