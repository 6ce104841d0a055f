#include "pipeline/calibrate/from_boards.h"

namespace dressform {
namespace {

struct SbDistortionParams {
  BoardParams boards;
};
template <class V>
void fields(V& v, SbDistortionParams& p) {
  fields(v, p.boards);
}

// The thesis's way with distortion (k1, k2, p1, p2, k3; Brown, "Close-range camera calibration", 1971), and a depth
// offset from the boards' planes.
Calibrated sb_distortion(const CaptureSession& session, const SbDistortionParams& params) {
  return calibrate_from_boards(session, params.boards, by_sb_distortion);
}

const Calibrate::Variant sb_distortion_variant{"sb_distortion", sb_distortion};

}  // namespace

BoardSolution by_sb_distortion(const SensorBoards& boards, const BoardParams&) {
  BoardSolution solution = opencv_calibration(boards, true);
  solution.sensor.depth_offset_m = depth_offset_m(boards, solution);
  return solution;
}

}  // namespace dressform
