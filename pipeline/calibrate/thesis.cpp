#include "pipeline/calibrate/from_boards.h"

namespace dressform {
namespace {

struct ThesisParams {
  BoardParams boards;
};
template <class V>
void fields(V& v, ThesisParams& p) {
  fields(v, p.boards);
}

// Section 3.1 of the thesis: `calibrateCamera` for each camera without distortion, `stereoCalibrate` between them, no
// depth offset.
Calibrated thesis(const CaptureSession& session, const ThesisParams& params) {
  return calibrate_from_boards(session, params.boards, by_thesis);
}

const Calibrate::Variant thesis_variant{"thesis", thesis};

}  // namespace

BoardSolution by_thesis(const SensorBoards& boards, const BoardParams&) { return opencv_calibration(boards, false); }

}  // namespace dressform
