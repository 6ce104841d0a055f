#include <fmt/format.h>

#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "eval/cli/progress.h"
#include "eval/inspect/inspect_session.h"
#include "synthetic/sensors/sensor_model.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

struct InspectOptions : CommonOptions {
  fs::path session;
  std::string sensor;
};

fs::path output_of(const InspectOptions& options) {
  if (!options.output.empty()) return options.output;
  if (!options.sensor.empty()) return "inspect_" + options.sensor;
  fs::path session = fs::absolute(options.session).lexically_normal();
  if (!session.has_filename()) session = session.parent_path();
  return "inspect_" + session.filename().string();
}

FieldValues sensor_values(const InspectOptions& options) {
  const Choices choices = parse_choices(options);
  if (!choices.reconstruction.values.empty())
    throw InputError("--set " + choices.reconstruction.values.begin()->first, "expected sensor.parameter=value");
  return choices.sensor.values;
}

int inspect(const InspectOptions& options) {
  const ThreadLimit threads(options.threads);
  if (options.session.empty() == options.sensor.empty())
    throw InputError("inspect", "found both or neither of a session and --sensor; expected one of them");
  const fs::path output = output_of(options);
  if (fs::exists(output))
    throw InputError("-o " + output.string(), "exists already; expected the name of a new folder");
  Progress progress(options.quiet);
  const auto report = [&](const std::string& what, int done, int total) { progress.update(what, done, total); };
  if (options.sensor.empty() && !options.values.empty()) throw InputError("--set", "expected --sensor with it");
  const Inspection inspection = options.sensor.empty() ? inspect_session(read_capture_session(options.session), report)
                                                       : inspect_sensor(options.sensor, sensor_values(options), report);
  write_inspection(inspection, output);
  const InspectionCount count = count_of(inspection);
  progress.finish("inspect", fmt::format("{} images", count.images));
  for (const auto& section : inspection.sections)
    for (const auto& finding : section.findings)
      fmt::print("  {:<44} {:>10.4g} {:<16}{}\n", finding.what, finding.shown(), finding.unit,
                 !finding.judged() ? ""
                                   : fmt::format("{} [{:.4g}, {:.4g}]", finding.good() ? "within" : "OUTSIDE",
                                                 finding.low, finding.high));
  if (count.judged > 0) fmt::print("{} of {} judged figures within tolerance\n", count.good, count.judged);
  fmt::print("page: {}\n", (output / "inspect.html").string());
  return kSuccess;
}

Command add_inspect_command(CLI::App& app) {
  auto options = std::make_shared<InspectOptions>();
  auto* command = app.add_subcommand("inspect", "Images and noise statistics of a session or of a sensor model");
  command->add_option("session", options->session, "capture session folder");
  command->add_option("--sensor", options->sensor, "instead of a session: a sensor model, on known planes")
      ->check(CLI::IsMember(SensorModel::names()));
  command->add_option("-o,--output", options->output, "the new folder; default inspect_<session or sensor>");
  command->add_option("--set", options->values, "sensor.parameter=value, with --sensor (repeatable)")
      ->allow_extra_args(false);
  add_threads(*command, *options);
  command->footer(
      "Example:\n"
      "  dressform inspect sessions/group2 -o looks/group2\n"
      "  dressform inspect --sensor kinect_v2 -o looks/kinect_v2");
  return [options] { return inspect(*options); };
}

const RegisteredCommand registered_inspect{60, add_inspect_command};

}  // namespace
}  // namespace dressform
