#include <fmt/format.h>

#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "eval/metrics/calibration_metrics.h"
#include "eval/run/calibrated_json.h"
#include "scenes/calibration_json.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

struct CalibrateOptions : CommonOptions {
  fs::path session;
};

void print_camera(const char* name, const Camera& camera) {
  fmt::print(
      "  {:<6} fx {:.3f} fy {:.3f} cx {:.3f} cy {:.3f} px, distortion [{:.4f}, {:.4f}, {:.5f}, {:.5f}, {:.4f}]\n", name,
      camera.fx, camera.fy, camera.cx, camera.cy, camera.distortion[0], camera.distortion[1], camera.distortion[2],
      camera.distortion[3], camera.distortion[4]);
}

void print_report(const BoardReport& report) {
  fmt::print("  boards {} shots, {} found in infrared and {} in colour, {} and {} used, {} turned by 180 degrees\n",
             report.shots, report.found_ir, report.found_color, report.used_ir, report.used_color, report.turned);
  fmt::print("  rms    infrared {:.3f} px, colour {:.3f} px; focal length +- {:.3f} % and {:.3f} %{}\n",
             report.ir_rms_px, report.color_rms_px, 100 * report.ir_focal_sigma, 100 * report.color_focal_sigma,
             report.converged ? "" : "; NOT CONVERGED");
  if (report.depth_views > 0)
    fmt::print("  depth  off the boards' planes by {:.2f} mm rms, {:+.2f} mm per metre, {} boards\n",
               report.depth_rms_mm, report.depth_slope_mm_per_m, report.depth_views);
}

void print_errors(const metrics::SensorErrors& errors) {
  fmt::print("  errors infrared f {:.4f} %, c {:.3f} px", errors.ir.focal_percent, errors.ir.principal_px);
  if (errors.color)
    fmt::print("; colour f {:.4f} %, c {:.3f} px; step {:.4f} deg, {:.3f} mm", errors.color->focal_percent,
               errors.color->principal_px, errors.color_from_ir_deg, errors.color_from_ir_mm);
  fmt::print("; depth offset {:.3f} mm; at 2.1 m {:.2f} mm, {:.2f} px\n", errors.depth_offset_mm, errors.point_mm,
             errors.mapping_px);
}

void print_sensor(const Calibrated& calibrated, const std::string& name, const Calibration* truth) {
  const SensorCalibration& sensor = calibrated.calibration.sensors.at(name);
  const auto report = calibrated.boards.find(name);
  fmt::print("{}: from {}\n", name, report == calibrated.boards.end() ? "calibration.json" : "boards");
  print_camera("ir", sensor.ir);
  if (sensor.color) {
    print_camera("color", *sensor.color);
    const Vector3d step = 1000 * sensor.color_from_ir.translation();
    fmt::print("  step   {:+.2f} {:+.2f} {:+.2f} mm, {:.3f} deg\n", step.x(), step.y(), step.z(),
               Eigen::AngleAxisd(sensor.color_from_ir.linear()).angle() * 180 / M_PI);
  }
  fmt::print("  depth  offset {:+.2f} mm\n", 1000 * sensor.depth_offset_m);
  if (report != calibrated.boards.end()) print_report(report->second);
  const auto note = calibrated.notes.find(name);
  if (note != calibrated.notes.end()) fmt::print("  note   {}\n", note->second);
  if (truth && truth->sensors.count(name)) print_errors(metrics::sensor_errors(sensor, truth->sensors.at(name)));
}

int calibrate_session(const CalibrateOptions& options) {
  const ThreadLimit threads(options.threads);
  const ReconstructionOptions choices = parse_choices(options).reconstruction;
  check_options(choices);
  if (!options.output.empty() && fs::exists(options.output))
    throw InputError("-o " + options.output.string(), "exists already; expected the name of a new file");
  const auto variant = choices.variants.find("calibrate");
  const auto& entry = Calibrate::at(variant == choices.variants.end() ? Calibrate::default_variant() : variant->second);
  const auto given = choices.values.find("calibrate");
  const FieldValues values = entry.complete(given == choices.values.end() ? FieldValues{} : given->second);
  const Calibrated calibrated = entry.run(read_capture_session(options.session), values, choices.seed);
  const fs::path truth_file = options.session / "truth" / "calibration.json";
  std::optional<Calibration> truth;
  if (fs::exists(truth_file)) truth = read_calibration(truth_file);
  for (const auto& [name, sensor] : calibrated.calibration.sensors)
    print_sensor(calibrated, name, truth ? &*truth : nullptr);
  if (options.output.empty()) return kSuccess;
  write_file_atomically(options.output, calibrated_json(calibrated));
  fmt::print("calibration: {}\n", options.output.string());
  return kSuccess;
}

Command add_calibrate_command(CLI::App& app) {
  auto options = std::make_shared<CalibrateOptions>();
  auto* command = app.add_subcommand("calibrate", "Calibrate the sensors of a session from its boards");
  command->add_option("session", options->session, "capture session folder")->required();
  command->add_option("-o,--output", options->output, "a new calibration.json; default: only print");
  add_choices(*command, *options);
  add_threads(*command, *options);
  command->footer("Example:\n  dressform calibrate sessions/lab --variant calibrate=bundle -o calibration.json");
  return [options] { return calibrate_session(*options); };
}

const RegisteredCommand registered_calibrate{50, add_calibrate_command};

}  // namespace
}  // namespace dressform
