#pragma once
#include "pipeline/calibrate/board_views.h"

namespace dressform {

// What an adjustment may change, and how much it trusts what.
struct AdjustOptions {
  bool fit_cameras = true;       // focal lengths, principal points, distortion of the cameras it uses
  bool fit_step = true;          // color_from_ir
  bool fit_offset = true;        // depth offset
  bool use_color = true;         // corners in colour
  bool use_depth = true;         // depth measured on the board
  double depth_sigma_m = 0.005;  // error that all depth of one board shares
  int max_iterations = 100;
};

struct BoardSolution {
  SensorCalibration sensor;
  std::vector<Isometry3d> ir_from_board;  // by view
  bool converged = false;
  int iterations = 0;
  double ir_rms_px = 0, color_rms_px = 0;            // root mean square distance of corners
  double ir_focal_sigma = 0, color_focal_sigma = 0;  // relative, from the normal equations
};

// Bundle adjustment of one sensor's cameras and of the boards' poses: least squares of the corners' distances in both
// images (Huber; each camera weighted by its own scatter) and of measured depth - offset - board plane along each ray.
// The cameras have weak priors (principal point in the middle within 5 % of the width, square pixels within 2 %,
// distortion of the usual size, a depth offset within 30 mm), which decide only where the boards do not: three boards,
// or all of them frontal. Levenberg-Marquardt on the Schur complement of the poses. Poses of views that only colour has
// are carried along.
BoardSolution adjust_boards(const SensorBoards& boards, const BoardSolution& start, const AdjustOptions& options);

// Residuals of every view: root mean square distances (NaN where the corners were not found), mean of measured depth -
// offset - plane and the board's distance (NaN without depth).
struct ViewResidual {
  double ir_px = 0, color_px = 0, depth_m = 0, distance_m = 0;
};
std::vector<ViewResidual> view_residuals(const SensorBoards& boards, const BoardSolution& solution);

// Starting poses for the cameras of `sensor`: from infrared, or from colour where infrared found nothing.
std::vector<Isometry3d> start_poses(const SensorBoards& boards, const SensorCalibration& sensor);

}  // namespace dressform
