#include "pipeline/calibrate/board_square.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/calibrate/board_adjustment.h"
#include "scenes/error.h"
#include "scenes/length_units.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double kDepthError = 0.1;  // of the distance: an offset of 30 mm at 0.5 m, and the sensor's own scale
// Of the ratio from view to view, relative: a wrong square changes all views alike; depth of something else than the
// board, or of a mirrored image, does not.
constexpr double kLargestScatter = 0.05;
// Of a ratio and what explains it, log: beyond the error of depth, well within the step from one unit to the next.
constexpr double kAlike = 0.15;
constexpr double kSigmas = 5;        // of the ratio, for a contradiction
constexpr double kSureFocal = 0.05;  // relative sigma up to which the corners alone fix the focal length
// Focal lengths over the width of depth cameras: 28 to 127 degrees of view.
constexpr double kLeastFocal = 0.25, kMostFocal = 2, kUsualFocal = 0.72;

// The views with infrared corners; `depth`: with what was measured on them.
SensorBoards in_infrared(const SensorBoards& boards, bool depth) {
  SensorBoards result = boards;
  auto& views = result.views;
  views.erase(std::remove_if(views.begin(), views.end(), [](const BoardView& view) { return view.ir.empty(); }),
              views.end());
  if (!depth)
    for (auto& view : views) view.depth.clear();
  return result;
}

std::string likely_unit(double ratio) {
  const auto near = [&](double factor) { return std::abs(std::log(ratio / factor)) < kAlike; };
  for (const char* name : {"mm", "cm", "inch"}) {
    const LengthUnit& unit = length_unit(name);
    if (near(unit.metres)) return std::string(" (looks like ") + unit.plural + ")";
  }
  if (near(0.1) || near(10)) return " (looks like a decimal place)";
  if (near(0.5) || near(2)) return " (looks like two squares taken for one, or one for two)";
  return "";
}

[[noreturn]] void blame_square(const SensorBoards& boards, double ratio, const std::string& by) {
  throw InputError(
      "session.json: boards.square_m",
      fmt::format("found squares of {:g} m, but the depth measured on the boards of {} is {:.3g} times "
                  "what squares of this size have {}; expected the side of one square in metres, about "
                  "{:.3g} m by the depth images{}",
                  boards.grid.square_m, boards.sensor, ratio, by, ratio * boards.grid.square_m, likely_unit(ratio)));
}

}  // namespace

SquareEvidence square_evidence(const SensorBoards& boards) {
  const SensorBoards corners = in_infrared(boards, false), measured = in_infrared(boards, true);
  SquareEvidence evidence;
  if (corners.views.size() < 3) return evidence;
  BoardSolution solution;
  solution.sensor.ir = rough_ir_camera(corners);
  solution.ir_from_board = start_poses(corners, solution.sensor);
  AdjustOptions options;
  options.use_color = options.use_depth = options.fit_offset = options.fit_step = false;
  solution = adjust_boards(corners, solution, options);
  std::vector<double> ratios;
  for (const auto& residual : view_residuals(measured, solution))
    if (std::isfinite(residual.depth_m) && residual.distance_m > 0)
      ratios.push_back(1 + residual.depth_m / residual.distance_m);
  evidence.views = static_cast<int>(ratios.size());
  if (ratios.empty()) return evidence;
  evidence.depth_ratio = median(ratios);
  std::vector<double> off;
  for (const double ratio : ratios) off.push_back(std::abs(ratio / evidence.depth_ratio - 1));
  evidence.scatter = median(off);
  if (solution.converged && std::isfinite(solution.ir_focal_sigma)) evidence.sigma = solution.ir_focal_sigma;
  return evidence;
}

void check_square(const SensorBoards& boards) {
  const SquareEvidence evidence = square_evidence(boards);
  if (evidence.views == 0 || evidence.scatter > kLargestScatter) return;
  if (evidence.sigma < kSureFocal) {
    const double off = std::abs(std::log(std::max(evidence.depth_ratio, 1e-6)));
    if (off > std::max(kDepthError, kSigmas * evidence.sigma))
      blame_square(boards, evidence.depth_ratio, "by the perspective of their corners");
    return;
  }
  const double focal = rough_ir_camera(boards).fx / boards.ir_size.width;
  if (focal < kLeastFocal || focal > kMostFocal)
    blame_square(boards, focal / kUsualFocal, "with any depth camera's field of view");
}

}  // namespace dressform
