#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/end_to_end_progress.h"
#include "eval/cli/options.h"

namespace dressform {
namespace {

struct ReconstructOptions : CommonOptions {
  std::filesystem::path session;
};

int reconstruct_session(ReconstructOptions options) {
  const ThreadLimit threads(options.threads);
  const Choices choices = parse_choices(options);
  if (!choices.sensor.variant.empty() || !choices.sensor.values.empty())
    throw InputError("--variant/--set sensor", "a recorded session has no sensor model to choose; expected a stage");
  const std::string name = std::filesystem::absolute(options.session).lexically_normal().filename().string();
  if (options.output.empty()) options.output = std::filesystem::path("runs") / name;
  Progress progress(options.quiet);
  EndToEndRequest request{options.session,        options.output, store_folder(options), name, variant_text(options),
                          choices.reconstruction, true,           threads.count()};
  return print_summary(run_end_to_end(request, end_to_end_progress(progress)));
}

Command add_reconstruct_command(CLI::App& app) {
  auto options = std::make_shared<ReconstructOptions>();
  auto* command = app.add_subcommand("reconstruct", "From a capture session on disk to clothes, scores and report");
  command->add_option("session", options->session, "capture session folder")->required();
  add_output(*command, *options, "run folder; default runs/<session>");
  command->add_option("--seed", options->seed, "seed of stages that draw random numbers (default 1)");
  add_preset(*command, *options);
  add_choices(*command, *options);
  add_threads(*command, *options);
  command->footer("Example:\n  dressform reconstruct sessions/group2 -o runs/group2");
  return [options] { return reconstruct_session(*options); };
}

const RegisteredCommand registered_reconstruct{40, add_reconstruct_command};

}  // namespace
}  // namespace dressform
