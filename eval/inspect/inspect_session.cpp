#include "eval/inspect/inspect_session.h"

#include <fmt/format.h>

#include "eval/inspect/session_images.h"
#include "eval/inspect/session_noise.h"
#include "eval/inspect/session_points.h"

namespace dressform {
namespace {

std::string summary_of(const CaptureSession& session) {
  std::size_t frames = 0;
  for (const auto& [name, scan] : session.scans) frames += scan.depth_mm.size();
  return fmt::format("{} sensors, {} naked and {} dressed shots, {} frames of {} scans, {}, {}. By {}, licence {}.",
                     session.sensors.size(), session.naked.size(), session.dressed.size(), frames, session.scans.size(),
                     session.calibration ? "calibrated" : "to be calibrated from boards",
                     session.prior ? "with a rig prior" : "without a rig prior",
                     session.created_by.empty() ? "an unknown program" : session.created_by,
                     session.licence.empty() ? "unknown" : session.licence);
}

}  // namespace

Inspection inspect_session(const CaptureSession& session, const InspectionProgress& progress) {
  Inspection inspection;
  inspection.title = "Session " + session.name;
  inspection.summary = summary_of(session);
  progress("streams", 0, 3);
  inspection.sections = stream_sections(session);
  progress("points", 1, 3);
  Renderer renderer;
  if (auto points = points_section(session, renderer); !points.figures.empty())
    inspection.sections.push_back(std::move(points));
  progress("noise", 2, 3);
  for (auto& section : noise_sections(session)) inspection.sections.push_back(std::move(section));
  return inspection;
}

}  // namespace dressform
