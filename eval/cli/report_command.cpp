#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/end_to_end_progress.h"
#include "eval/cli/options.h"
#include "eval/run/recorded_request.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

struct ReportOptions : CommonOptions {
  fs::path run;
};

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
