#include <fmt/format.h>

#include <fstream>
#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/end_to_end_progress.h"
#include "eval/cli/options.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct ReportOptions : CommonOptions {
  fs::path run;
};

// The request that made a run, from its run.json.
EndToEndRequest recorded_request(const fs::path& run) {
  const fs::path file = run / "run.json";
  std::ifstream in(file);
  if (!in) throw InputError(file.string(), "can't be read; expected the run.json of a run folder");
  try {
    json facts = json::parse(in);
    EndToEndRequest request;
    request.session = facts.at("session").at("path").get<std::string>();
    request.output = run;
    request.store = facts.at("store").get<std::string>();
    request.scene = facts.at("scene");
    request.variant = facts.at("variant");
    request.options.seed = facts.at("seed");
    request.options.variants = facts.at("options").at("variants").get<std::map<std::string, std::string>>();
    for (const auto& [stage, values] : facts.at("options").at("values").items())
      for (const auto& [name, value] : values.items()) request.options.values[stage][name] = value.get<std::string>();
    for (const char* key : {"scene_file", "scene_toml", "scale", "sensor_model", "capture"})
      if (facts.contains(key)) request.facts[key] = facts[key];
    return request;
  } catch (const json::exception& error) {
    throw InputError(file.string(), std::string("damaged (") + error.what() + ")");
  }
}

int report_run(const ReportOptions& options) {
  const ThreadLimit threads(options.threads);
  EndToEndRequest request = recorded_request(options.run);
  request.threads = threads.count();
  fs::remove(options.run / "report.html");  // so that it is written again
  Progress progress(options.quiet);
  return print_summary(run_end_to_end(request, end_to_end_progress(progress)));
}

Command add_report_command(CLI::App& app) {
  auto options = std::make_shared<ReportOptions>();
  auto* command = app.add_subcommand("report", "Write a run's report and images again");
  command->add_option("run", options->run, "run folder")->required();
  add_threads(*command, *options);
  command->footer("Example:\n  dressform report runs/group1");
  return [options] { return report_run(*options); };
}

const RegisteredCommand registered_report{90, add_report_command};

}  // namespace
}  // namespace dressform
