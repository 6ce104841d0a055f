#include "pipeline/calibrate/from_boards.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/calibrate/board_square.h"
#include "scenes/error.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double impossible_depth_m = 0.15;  // of a board's mean depth: such an image shows something else
constexpr double sure_focal = 0.01;          // relative sigma up to which a focal length counts as found
constexpr int rejections = 2;                // rounds of leaving out bad views: the second sees what the first hid
constexpr int views_for_slope = 3;           // with depth, and ...
constexpr double spread_for_slope_m = 0.01;  // ... deviation of their distances, to tell how depth grows with it
constexpr double least_step_m = 0.02;        // between the two cameras along x: less has no sign

// Residual above which a view goes. Where all views are equally good, none goes for a trifle.
double limit_of(std::vector<double> residuals, double reject_mad) {
  constexpr double kTrifle = 0.3;  // of the median residual
  const double typical = median(residuals);
  for (auto& residual : residuals) residual = std::abs(residual - typical);
  return typical + std::max(kTrifle * typical, reject_mad * kSigmaPerMedianDeviation * median(std::move(residuals)));
}

// Clears the corners of one camera in the views that fit badly, the worst first, as long as enough are left.
int reject(SensorBoards& boards, std::vector<Vector2d> BoardView::*corners, const std::vector<double>& residuals,
           const BoardParams& params) {
  std::vector<double> finite;
  for (const double residual : residuals)
    if (std::isfinite(residual)) finite.push_back(residual);
  if (finite.empty()) return 0;
  const double limit = limit_of(finite, params.reject_mad);
  std::vector<std::pair<double, std::size_t>> worst;
  for (std::size_t i = 0; i < residuals.size(); ++i)
    if (std::isfinite(residuals[i]) && residuals[i] > limit) worst.emplace_back(-residuals[i], i);
  std::sort(worst.begin(), worst.end());
  int dropped = 0;
  for (const auto& [negative, i] : worst) {
    if (static_cast<int>(finite.size()) - dropped <= params.min_views) break;
    BoardView& view = boards.views[i];
    (view.*corners).clear();
    if (corners == &BoardView::ir) view.depth.clear();
    ++dropped;
  }
  return dropped;
}

// Each camera by itself, then the pairs: a board that moved between the two images fits both, but not together.
int reject_bad_views(SensorBoards& boards, const BoardSolution& solution, const BoardParams& params) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> ir, color, pair;
  for (const auto& view : boards.views) {
    const SensorCalibration& sensor = solution.sensor;
    const auto alone = [&](const std::vector<Vector2d>& corners, const Camera& camera) {
      const Isometry3d pose = board_pose(camera, corners, boards.grid);
      double sum = 0;
      for (int i = 0; i < boards.grid.count(); ++i)
        sum += (camera.project(pose * boards.grid.point(i)) - corners[i]).squaredNorm();
      return std::sqrt(sum / boards.grid.count());
    };
    ir.push_back(view.ir.empty() ? none : alone(view.ir, sensor.ir));
    color.push_back(view.color.empty() || !sensor.color ? none : alone(view.color, *sensor.color));
  }
  int dropped = reject(boards, &BoardView::ir, ir, params) + reject(boards, &BoardView::color, color, params);
  const auto residuals = view_residuals(boards, with_fixed_cameras(boards, solution.sensor));
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const bool paired = !boards.views[i].ir.empty() && !boards.views[i].color.empty();
    pair.push_back(paired ? residuals[i].color_px : none);
  }
  dropped += reject(boards, &BoardView::color, pair, params);
  const auto gone = [](const BoardView& view) { return view.ir.empty() && view.color.empty(); };
  boards.views.erase(std::remove_if(boards.views.begin(), boards.views.end(), gone), boards.views.end());
  return dropped;
}

int count_of(const SensorBoards& boards, std::vector<Vector2d> BoardView::*corners) {
  return static_cast<int>(std::count_if(boards.views.begin(), boards.views.end(),
                                        [&](const BoardView& view) { return !(view.*corners).empty(); }));
}

void check_depth_shows_boards(const SensorBoards& boards, const std::vector<ViewResidual>& residuals, double offset_m) {
  int with_depth = 0, wrong = 0;
  for (const auto& residual : residuals) {
    with_depth += std::isfinite(residual.depth_m);
    wrong += std::isfinite(residual.depth_m) && std::abs(residual.depth_m + offset_m) > impossible_depth_m;
  }
  if (2 * wrong > with_depth)
    throw InputError(
        "boards/" + boards.sensor,
        fmt::format("depth lies more than {} mm off the board in {} of {} shots; expected depth on the grid "
                    "of the infrared images, not mirrored, and the board's square_m",
                    static_cast<int>(1000 * impossible_depth_m), wrong, with_depth));
}

void add_depth(const std::vector<ViewResidual>& residuals, BoardReport& report) {
  double n = 0, sz = 0, sd = 0, szz = 0, szd = 0, sdd = 0;
  for (const auto& residual : residuals) {
    if (!std::isfinite(residual.depth_m)) continue;
    const double z = residual.distance_m, d = residual.depth_m;
    n += 1, sz += z, sd += d, szz += z * z, szd += z * d, sdd += d * d;
  }
  report.depth_views = static_cast<int>(n);
  if (n == 0) return;
  report.depth_rms_mm = 1000 * std::sqrt(sdd / n);
  const double spread = szz - sz * sz / n;
  if (n >= views_for_slope && spread / n > spread_for_slope_m * spread_for_slope_m)
    report.depth_slope_mm_per_m = 1000 * (szd - sz * sd / n) / spread;
}

std::string note_on_mirroring(const SensorCalibration& found, const SensorCalibration* given) {
  if (!given || !given->color || !found.color) return {};
  const double a = found.color_from_ir.translation().x(), b = given->color_from_ir.translation().x();
  if (std::abs(a) < least_step_m || std::abs(b) < least_step_m || a * b > 0) return {};
  return fmt::format(
      "the step from infrared to colour is {:+.1f} mm along x by the boards and {:+.1f} mm in calibration.json: the "
      "images of one of them are mirrored",
      1000 * a, 1000 * b);
}

// Measured depth is d + s z: a slope s is a scale that squares or sensor have wrong.
std::string note_on_slope(const BoardReport& report, const BoardGrid& grid) {
  constexpr double kUnexplained = 10;  // mm/m, a part in a hundred: more than focal lengths found to 1 % leave
  if (report.depth_views == 0 || std::abs(report.depth_slope_mm_per_m) < kUnexplained) return {};
  return fmt::format(
      "measured depth departs from the boards' planes by {:+.1f} mm per metre: the squares are {:.4g} m rather than "
      "{:g} "
      "m, or the sensor's own scale is {:+.1f} % off (measure the board; a depth offset does not mend this)",
      report.depth_slope_mm_per_m, grid.square_m * (1 + 1e-3 * report.depth_slope_mm_per_m), grid.square_m,
      0.1 * report.depth_slope_mm_per_m);
}

std::string note_on_missing_depth(const SensorBoards& boards, const SensorCalibration* given) {
  if (has_depth(boards)) return {};
  return fmt::format("no depth on the boards in any of {} shots: the depth offset is not known, {}", boards.shots,
                     given ? "that of calibration.json is kept" : "0 is taken");
}

std::string joined_notes(std::initializer_list<std::string> notes) {
  std::string text;
  for (const auto& note : notes)
    if (!note.empty()) text += (text.empty() ? "" : "; ") + note;
  return text;
}

bool all_finite(const SensorCalibration& sensor) {
  const auto good = [](const Camera& camera) {
    return std::isfinite(camera.fx + camera.fy + camera.cx + camera.cy) && camera.fx > 0 && camera.fy > 0;
  };
  return good(sensor.ir) && (!sensor.color || good(*sensor.color)) && sensor.color_from_ir.matrix().allFinite() &&
         std::isfinite(sensor.depth_offset_m);
}

// Fits, leaves out the views that fit badly, fits again.
BoardSolution without_bad_views(SensorBoards& boards, const BoardParams& params, const BoardMethod& method) {
  BoardSolution solution = method(boards, params);
  for (int round = 0; round < rejections; ++round) {
    if (!all_finite(solution.sensor)) break;
    if (reject_bad_views(boards, solution, params) == 0) break;
    solution = method(boards, params);
  }
  if (!all_finite(solution.sensor))
    throw InputError("boards/" + boards.sensor,
                     "no finite calibration comes out; expected boards at several distances and tilts");
  return solution;
}

// What is left between the final cameras and the boards.
void measure(const SensorBoards& boards, const SensorCalibration& sensor, BoardReport& report) {
  report.used_ir = count_of(boards, &BoardView::ir);
  report.used_color = count_of(boards, &BoardView::color);
  const BoardSolution measured = with_fixed_cameras(boards, sensor);
  const auto residuals = view_residuals(boards, measured);
  check_depth_shows_boards(boards, residuals, sensor.depth_offset_m);
  report.ir_rms_px = measured.ir_rms_px;
  report.color_rms_px = measured.color_rms_px;
  add_depth(residuals, report);
}

}  // namespace

const SensorCalibration* given_for(const CaptureSession& session, const std::string& sensor) {
  if (!session.calibration) return nullptr;
  const auto found = session.calibration->sensors.find(sensor);
  return found == session.calibration->sensors.end() ? nullptr : &found->second;
}

bool has_depth(const SensorBoards& boards) {
  return std::any_of(boards.views.begin(), boards.views.end(), enough_depth);
}

double depth_offset_m(const SensorBoards& boards, const BoardSolution& solution) {
  std::vector<double> offsets;
  for (const auto& residual : view_residuals(boards, solution))
    if (std::isfinite(residual.depth_m)) offsets.push_back(residual.depth_m);
  return solution.sensor.depth_offset_m + median_or(std::move(offsets), 0.0);
}

BoardSolution with_fixed_cameras(const SensorBoards& boards, const SensorCalibration& sensor) {
  BoardSolution start;
  start.sensor = sensor;
  start.ir_from_board = start_poses(boards, sensor);
  AdjustOptions options;
  options.fit_cameras = options.fit_step = options.fit_offset = options.use_depth = false;
  return adjust_boards(boards, start, options);
}

std::string problem_with(const SensorBoards& boards, const BoardParams& params) {
  int ir = 0, color = 0, both = 0;
  for (const auto& view : boards.views) {
    ir += !view.ir.empty();
    color += !view.color.empty();
    both += !view.ir.empty() && !view.color.empty();
  }
  const bool wants_color = boards.color_size.area() > 0;
  if (ir >= params.min_views && (!wants_color || (color >= params.min_views && both >= 1))) return {};
  return fmt::format(
      "found the board of {} x {} inner corners in {} infrared and {} colour images of {} shots, in both of {}; "
      "expected at least {} in each kind and one pair, with the whole board in the image",
      boards.grid.columns, boards.grid.rows, ir, color, boards.shots, both, params.min_views);
}

SensorFit fit_sensor(SensorBoards boards, const BoardParams& params, const BoardMethod& method,
                     const SensorCalibration* given) {
  check_square(boards);
  SensorFit fit;
  BoardReport& report = fit.report;
  report.shots = boards.shots;
  report.turned = boards.turned;
  report.found_ir = count_of(boards, &BoardView::ir);
  report.found_color = count_of(boards, &BoardView::color);
  const BoardSolution solution = without_bad_views(boards, params, method);
  fit.sensor = solution.sensor;
  if (given) fit.sensor.model = given->model;
  if (given && !has_depth(boards)) fit.sensor.depth_offset_m = given->depth_offset_m;
  measure(boards, fit.sensor, report);
  report.ir_focal_sigma = solution.ir_focal_sigma;
  report.color_focal_sigma = solution.color_focal_sigma;
  report.converged = solution.converged && report.ir_focal_sigma < sure_focal && report.color_focal_sigma < sure_focal;
  fit.note = joined_notes(
      {note_on_mirroring(fit.sensor, given), note_on_missing_depth(boards, given), note_on_slope(report, boards.grid)});
  return fit;
}

Calibrated calibrate_from_boards(const CaptureSession& session, const BoardParams& params, const BoardMethod& method) {
  if (!session.boards)
    throw InputError("session.json: boards", "the session has none; expected shots of a checkerboard");
  Calibrated result;
  if (session.calibration) result.calibration = *session.calibration;
  for (const auto& sensor : session.sensors) {
    const auto shots = session.boards->shots.find(sensor);
    if (shots == session.boards->shots.end() || shots->second.empty()) {
      if (!given_for(session, sensor))
        throw InputError("boards/" + sensor, "has no shots, and calibration.json no such sensor; expected one of them");
      continue;
    }
    SensorBoards boards = find_boards(*session.boards, sensor);
    const std::string problem = problem_with(boards, params);
    if (!problem.empty()) throw InputError("boards/" + sensor, problem);
    SensorFit fit = fit_sensor(std::move(boards), params, method, given_for(session, sensor));
    result.calibration.sensors[sensor] = fit.sensor;
    result.boards[sensor] = fit.report;
    if (!fit.note.empty()) result.notes[sensor] = fit.note;
  }
  return result;
}

}  // namespace dressform
