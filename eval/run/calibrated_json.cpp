#include "eval/run/calibrated_json.h"

#include "scenes/calibration_json.h"

namespace dressform {
namespace {

nlohmann::ordered_json to_json(const BoardReport& report) {
  return {{"shots", report.shots},
          {"found_ir", report.found_ir},
          {"found_color", report.found_color},
          {"used_ir", report.used_ir},
          {"used_color", report.used_color},
          {"turned", report.turned},
          {"ir_rms_px", report.ir_rms_px},
          {"color_rms_px", report.color_rms_px},
          {"depth_views", report.depth_views},
          {"depth_rms_mm", report.depth_rms_mm},
          {"depth_slope_mm_per_m", report.depth_slope_mm_per_m},
          {"ir_focal_sigma", report.ir_focal_sigma},
          {"color_focal_sigma", report.color_focal_sigma},
          {"converged", report.converged}};
}

}  // namespace

std::string calibrated_json(const Calibrated& calibrated) {
  auto json = calibration_json(calibrated.calibration);
  for (const auto& [sensor, report] : calibrated.boards) json["boards"][sensor] = to_json(report);
  for (const auto& [sensor, note] : calibrated.notes) json["notes"][sensor] = note;
  return json.dump(1) + "\n";
}

}  // namespace dressform
