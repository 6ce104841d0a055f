#include "pipeline/calibrate/from_boards.h"
#include "scenes/error.h"

namespace dressform {
namespace {

struct AutomaticParams {
  BoardParams boards;
};
template <class V>
void fields(V& v, AutomaticParams& p) {
  fields(v, p.boards);
}

// Takes a sensor's cameras from its boards; the reason where they do not give them.
std::string take_from_boards(const CaptureSession& session, const std::string& sensor, const BoardParams& params,
                             Calibrated& result) {
  const auto shots = session.boards->shots.find(sensor);
  if (shots == session.boards->shots.end() || shots->second.empty()) return "no shots of a board";
  SensorBoards boards = find_boards(*session.boards, sensor);
  const std::string problem = problem_with(boards, params);
  if (!problem.empty()) return problem;
  const SensorCalibration* given = given_for(session, sensor);
  const SensorFit fit = fit_sensor(std::move(boards), params, by_bundle, given);
  if (given && !fit.report.converged) return "the boards do not fix the focal length";
  result.calibration.sensors[sensor] = fit.sensor;
  result.boards[sensor] = fit.report;
  if (!fit.note.empty()) result.notes[sensor] = fit.note;
  return {};
}

// Each sensor from its boards, by the method of `bundle`, where they were found and fix its focal lengths; else from
// the session's own calibration, with a note. A session without boards keeps the calibration that it brings along.
Calibrated automatic(const CaptureSession& session, const AutomaticParams& params) {
  if (!session.boards && !session.calibration)
    throw InputError("calibration.json", "the session has neither a calibration nor boards; expected one of them");
  Calibrated result;
  if (session.calibration) result.calibration = *session.calibration;
  if (!session.boards) return result;
  for (const auto& sensor : session.sensors) {
    const std::string problem = take_from_boards(session, sensor, params.boards, result);
    if (problem.empty()) continue;
    if (!given_for(session, sensor)) throw InputError("boards/" + sensor, problem);
    result.notes[sensor] = "calibration.json kept: " + problem;
  }
  return result;
}

const Calibrate::Variant automatic_variant{"automatic", automatic};

}  // namespace
}  // namespace dressform
