#pragma once
#include <functional>
#include <optional>

#include "pipeline/calibrate/board_adjustment.h"
#include "pipeline/calibrate/calibrate.h"

namespace dressform {

// What all variants that use boards share.
struct BoardParams {
  int min_views = 3;
  double reject_mad = 3;
  double depth_sigma_mm = 5;
};
template <class V>
void fields(V& v, BoardParams& p) {
  v("min_views", p.min_views, 2, 100, "", "boards that must be found in each image of a sensor");
  v("reject_mad", p.reject_mad, 1.0, 100.0, "",
    "views whose reprojection error lies this many deviations (from the median absolute one) above the median go");
  v("depth_sigma_mm", p.depth_sigma_mm, 0.1, 100.0, "mm", "error that all depth of one board shares");
}

// Cameras, step and depth offset of one sensor from its boards.
using BoardMethod = std::function<BoardSolution(const SensorBoards&, const BoardParams&)>;

// Why a sensor cannot be calibrated from what was found; empty: it can.
std::string problem_with(const SensorBoards& boards, const BoardParams& params);

struct SensorFit {
  SensorCalibration sensor;
  BoardReport report;
  std::string note;
};
// Calibrates, drops the views that fit badly, calibrates again, and measures what is left. Throws InputError where the
// depth images do not show the boards, or where nothing finite comes out.
SensorFit fit_sensor(SensorBoards boards, const BoardParams& params, const BoardMethod& method,
                     const SensorCalibration* given);

// All sensors of a session by one method. Throws InputError where the session has no boards, or where they were not
// found often enough, saying what was found and expected.
Calibrated calibrate_from_boards(const CaptureSession& session, const BoardParams& params, const BoardMethod& method);

// The methods of the variants.
BoardSolution opencv_calibration(const SensorBoards& boards, bool distortion);
BoardSolution by_thesis(const SensorBoards& boards, const BoardParams& params);
BoardSolution by_sb_distortion(const SensorBoards& boards, const BoardParams& params);
BoardSolution by_depth_plane(const SensorBoards& boards, const BoardParams& params);
BoardSolution by_bundle(const SensorBoards& boards, const BoardParams& params);

// Poses and residuals of given cameras: nothing but the boards moves.
BoardSolution with_fixed_cameras(const SensorBoards& boards, const SensorCalibration& sensor);

// Depth offset from the boards' planes: the median over the views. 0 without depth.
double depth_offset_m(const SensorBoards& boards, const BoardSolution& solution);
bool has_depth(const SensorBoards& boards);

// The session's own entry of a sensor; null where there is none.
const SensorCalibration* given_for(const CaptureSession& session, const std::string& sensor);

}  // namespace dressform
