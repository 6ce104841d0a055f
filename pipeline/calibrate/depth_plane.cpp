#include <algorithm>

#include "pipeline/calibrate/from_boards.h"

namespace dressform {
namespace {

struct DepthPlaneParams {
  BoardParams boards;
};
template <class V>
void fields(V& v, DepthPlaneParams& p) {
  fields(v, p.boards);
}

// The depth of the boards fixes the focal length: see by_depth_plane.
Calibrated depth_plane(const CaptureSession& session, const DepthPlaneParams& params) {
  return calibrate_from_boards(session, params.boards, by_depth_plane);
}

const Calibrate::Variant depth_plane_variant{"depth_plane", depth_plane};

}  // namespace

// Infrared camera and depth offset together, from the corners and from the depth measured on the boards: how the depth
// grows with distance fixes the focal length also where frontal boards leave it open. Then the colour camera by itself,
// and the step between the two with all else fixed.
BoardSolution by_depth_plane(const SensorBoards& boards, const BoardParams& params) {
  AdjustOptions options;
  options.depth_sigma_m = 1e-3 * params.depth_sigma_mm;
  options.use_color = false;
  options.use_depth = options.fit_offset = has_depth(boards);
  SensorBoards in_infrared = boards;
  auto& views = in_infrared.views;
  views.erase(std::remove_if(views.begin(), views.end(), [](const BoardView& view) { return view.ir.empty(); }),
              views.end());
  BoardSolution infrared;
  infrared.sensor.ir = rough_ir_camera(boards);
  infrared.ir_from_board = start_poses(in_infrared, infrared.sensor);
  infrared = adjust_boards(in_infrared, infrared, options);
  if (boards.color_size.area() == 0) return infrared;
  BoardSolution solution = opencv_calibration(boards, true);
  BoardSolution step = solution;
  step.sensor.ir = infrared.sensor.ir;
  step.sensor.depth_offset_m = infrared.sensor.depth_offset_m;
  step.ir_from_board = start_poses(boards, step.sensor);
  options = {};
  options.fit_cameras = options.fit_offset = options.use_depth = false;
  step = adjust_boards(boards, step, options);
  step.converged = step.converged && infrared.converged;
  step.ir_focal_sigma = infrared.ir_focal_sigma;
  step.color_focal_sigma = solution.color_focal_sigma;
  return step;
}

}  // namespace dressform
