#include "pipeline/calibrate/from_boards.h"

namespace dressform {
namespace {

struct BundleParams {
  BoardParams boards;
};
template <class V>
void fields(V& v, BundleParams& p) {
  fields(v, p.boards);
}

// All at once: both cameras, the step between them, the depth offset and the boards' poses. Triggs, McLauchlan, Hartley
// and Fitzgibbon, "Bundle adjustment - a modern synthesis", 1999.
Calibrated bundle(const CaptureSession& session, const BundleParams& params) {
  return calibrate_from_boards(session, params.boards, by_bundle);
}

const Calibrate::Variant bundle_variant{"bundle", bundle};

}  // namespace

BoardSolution by_bundle(const SensorBoards& boards, const BoardParams& params) {
  BoardSolution start;
  start.sensor.ir = rough_ir_camera(boards);
  if (boards.color_size.area() > 0) {
    start.sensor.color = rough_color_camera(boards);
    for (const auto& view : boards.views) {
      if (view.ir.empty() || view.color.empty()) continue;
      start.sensor.color_from_ir = board_pose(*start.sensor.color, view.color, boards.grid) *
                                   board_pose(start.sensor.ir, view.ir, boards.grid).inverse();
      break;
    }
  }
  start.ir_from_board = start_poses(boards, start.sensor);
  AdjustOptions options;
  options.depth_sigma_m = 1e-3 * params.depth_sigma_mm;
  options.use_depth = options.fit_offset = has_depth(boards);
  return adjust_boards(boards, start, options);
}

}  // namespace dressform
