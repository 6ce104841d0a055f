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

// Each sensor from its boards, by the method of `bundle`, where they were found and fix its focal lengths; else from
// the session's own calibration, with a note. A session without boards keeps the calibration that it brings along.
Calibrated automatic(const CaptureSession& session, const AutomaticParams& params) {
  if (!session.boards && !session.calibration)
    throw InputError("calibration.json", "the session has neither a calibration nor boards; expected one of them");
  Calibrated result;
  if (session.calibration) result.calibration = *session.calibration;
  if (!session.boards) return result;
  for (const auto& sensor : session.sensors) {
    const SensorCalibration* given = given_for(session, sensor);
    const auto shots = session.boards->shots.find(sensor);
    std::string problem = "no shots of a board";
    if (shots != session.boards->shots.end() && !shots->second.empty()) {
      SensorBoards boards = find_boards(*session.boards, sensor);
      problem = problem_with(boards, params.boards);
      if (problem.empty()) {
        SensorFit fit = fit_sensor(std::move(boards), params.boards, by_bundle, given);
        if (fit.report.converged || !given) {
          result.calibration.sensors[sensor] = fit.sensor;
          result.boards[sensor] = fit.report;
          if (!fit.note.empty()) result.notes[sensor] = fit.note;
          continue;
        }
        problem = "the boards do not fix the focal length";
      }
    }
    if (!given) throw InputError("boards/" + sensor, problem);
    result.notes[sensor] = "calibration.json kept: " + problem;
  }
  return result;
}

const Calibrate::Variant automatic_variant{"automatic", automatic};

}  // namespace
}  // namespace dressform
