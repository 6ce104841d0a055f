#include <fmt/format.h>

#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "eval/cli/progress.h"
#include "scenes/capture_session.h"
#include "scenes/ground_truth.h"
#include "synthetic/synthesize.h"

namespace dressform {
namespace {

struct SynthesizeOptions : CommonOptions {
  std::filesystem::path scene;
};

int synthesize_scene(const SynthesizeOptions& options) {
  const ThreadLimit threads(options.threads);
  const Scene scene = chosen_scene(options.scene, options);
  if (std::filesystem::exists(options.output))
    throw InputError("-o " + options.output.string(), "exists already; expected the name of a new session folder");
  Progress progress(options.quiet);
  const auto capture = synthesize(scene, options.seed, [&](int done, int total, const std::string& what) {
    progress.update("capturing " + what, done, total);
  });
  write_capture_session(options.output, capture.session);
  write_ground_truth(options.output, capture.truth);
  if (capture.picks) write_picks(options.output, *capture.picks);
  progress.finish("synthesize", "done");
  for (const std::string& line : drape_warnings(options.output)) progress.finish("warning", line);
  fmt::print("session: {}\n", options.output.string());
  return kSuccess;
}

Command add_synthesize_command(CLI::App& app) {
  auto options = std::make_shared<SynthesizeOptions>();
  auto* command = app.add_subcommand("synthesize", "Capture a scene: a capture session with its ground truth");
  command->add_option("scene", options->scene, "scene file (TOML)")->required();
  command->add_option("-o,--output", options->output, "the new session folder")->required();
  add_scene_options(*command, *options);
  add_choices(*command, *options);
  add_threads(*command, *options);
  command->footer("Example:\n  dressform synthesize scenes/library/group2.toml -o sessions/group2 --seed 7");
  return [options] { return synthesize_scene(*options); };
}

const RegisteredCommand registered_synthesize{20, add_synthesize_command};

}  // namespace
}  // namespace dressform
