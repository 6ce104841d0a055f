#include "scenes/import/merge_session.h"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/calibration_json.h"
#include "scenes/error.h"
#include "scenes/session_limits.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

void add_calibration(CaptureSession& session, const ImportRequest& request, const SensorCalibration& calibration) {
  if (!session.calibration) session.calibration.emplace();
  const auto [place, added] = session.calibration->sensors.emplace(request.sensor, calibration);
  if (added) return;
  const auto text = [](const SensorCalibration& sensor) { return calibration_json({{{"", sensor}}}).dump(); };
  if (text(place->second) != text(calibration))
    throw InputError("--sensor " + request.sensor, "found another calibration of this sensor in --with " +
                                                       request.with.string() + "; expected the same, or another name");
}

void add_boards(CaptureSession& session, const ImportRequest& request, int frames) {
  if (!session.boards) {
    session.boards.emplace();
    session.boards->inner_corners_x = request.inner_corners_x;
    session.boards->inner_corners_y = request.inner_corners_y;
    session.boards->square_m = request.square_m;
  }
  Boards& boards = *session.boards;
  if (boards.inner_corners_x != request.inner_corners_x || boards.inner_corners_y != request.inner_corners_y ||
      boards.square_m != request.square_m)
    throw InputError(
        "--board", fmt::format("found {}x{}x{} and {}x{}x{} in --with {}; expected one board for all "
                               "sensors of a session",
                               request.inner_corners_x, request.inner_corners_y, request.square_m,
                               boards.inner_corners_x, boards.inner_corners_y, boards.square_m, request.with.string()));
  boards.shots[request.sensor].resize(frames);
}

bool taken(const CaptureSession& session, const ImportRequest& request) {
  if (request.role == "boards") return session.boards && session.boards->shots.count(request.sensor);
  if (request.role == "naked") return session.naked.count(request.sensor);
  if (request.role == "dressed") return session.dressed.count(request.sensor);
  return session.scans.count(request.role);
}

// Sensors of the rig, in the order they came; those of scans only where there are no others, as one must be listed.
std::vector<std::string> sensors_of(const CaptureSession& session, const ImportRequest& request) {
  std::vector<std::string> known = session.sensors, result;
  if (std::find(known.begin(), known.end(), request.sensor) == known.end()) known.push_back(request.sensor);
  for (const auto& sensor : known)
    if (session.naked.count(sensor) || session.dressed.count(sensor) ||
        (session.boards && session.boards->shots.count(sensor)))
      result.push_back(sensor);
  return result.empty() ? known : result;
}

// What the format asks of a whole session.
void check_allowed(const CaptureSession& session) {
  for (const auto& sensor : session.sensors) {
    if (session.boards) {
      const auto shots = session.boards->shots.find(sensor);
      const std::size_t views = session.boards->shots.begin()->second.size();
      if (shots == session.boards->shots.end() || shots->second.size() != views)
        throw InputError(
            "boards of " + sensor,
            fmt::format("found {} shots; expected {} for every sensor of the session, as many as the first "
                        "has",
                        shots == session.boards->shots.end() ? 0 : shots->second.size(), views));
    }
    if (session.calibration ? !session.calibration->sensors.count(sensor) : !session.boards)
      throw InputError("calibration of " + sensor,
                       "is missing, while other sensors have one; expected it of all sensors or, with boards, of none");
  }
}

void note_what_is_missing(const CaptureSession& session, std::vector<std::string>& notes) {
  std::string missing;
  const auto note = [&](bool there, const char* what) {
    if (!there) missing += (missing.empty() ? "" : ", ") + std::string(what);
  };
  note(!session.naked.empty(), "naked shots");
  note(!session.dressed.empty(), "dressed shots");
  note(session.scans.count("scan_naked"), "scan_naked");
  note(session.scans.count("scan_user"), "scan_user (to fit to)");
  note(session.prior.has_value(), "a rig prior (registration then goes by the shapes alone)");
  if (!missing.empty()) notes.push_back("for `reconstruct` the session still lacks: " + missing);
}

}  // namespace

CaptureSession merged_session(const ImportRequest& request, const std::optional<SensorCalibration>& calibration,
                              int frames, std::vector<std::string>& notes) {
  CaptureSession session;
  if (!request.with.empty()) {
    session = read_session_outline(request.with);
    if (fs::exists(request.with / "truth")) notes.push_back("the truth of --with was left out");
  }
  if (!request.name.empty()) session.name = request.name;
  if (!request.licence.empty() || session.licence.empty())
    session.licence = request.licence.empty() ? "unknown" : request.licence;
  session.created_by = "dressform " DRESSFORM_VERSION;
  if (taken(session, request))
    throw InputError("--role " + request.role, "is taken in --with " + request.with.string() + "; expected a free one");
  if (request.role == "boards")
    add_boards(session, request, frames);
  else if (request.role == "naked" || request.role == "dressed")
    (request.role == "naked" ? session.naked : session.dressed)[request.sensor];
  else
    session.scans[request.role] = {request.sensor, std::vector<cv::Mat>(frames)};
  if (calibration) add_calibration(session, request, *calibration);
  session.sensors = sensors_of(session, request);
  if (request.world_from_sensor) {
    if (!session.prior) session.prior.emplace();
    session.prior->world_from_sensor[request.sensor] = *request.world_from_sensor;
    session.prior->rotation_sigma_deg = request.rotation_sigma_deg;
    session.prior->translation_sigma_m = request.translation_sigma_m;
  }
  if (session.prior)
    if (const auto found = problem_with_prior(*session.prior)) throw InputError("--place", found->problem);
  check_allowed(session);
  note_what_is_missing(session, notes);
  return session;
}

void copy_images(const fs::path& from, const fs::path& to) {
  for (const char* part : {"naked", "dressed", "scan_naked", "scan_user", "boards"})
    if (fs::is_directory(from / part)) fs::copy(from / part, to / part, fs::copy_options::recursive);
}

}  // namespace dressform
