#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/end_to_end_progress.h"
#include "eval/cli/options.h"

namespace dressform {
namespace {

struct RunOptions : CommonOptions {
  std::filesystem::path scene;
};

int run_scene_file(RunOptions options) {
  const ThreadLimit threads(options.threads);
  const Scene scene = chosen_scene(options.scene, options);
  if (options.output.empty()) options.output = std::filesystem::path("runs") / scene.name;
  Progress progress(options.quiet);
  return print_summary(run_scene({scene, options.scale, options.output, store_folder(options), variant_text(options),
                                  parse_choices(options).reconstruction, threads.count()},
                                 scene_progress(progress)));
}

Command add_run_command(CLI::App& app) {
  auto options = std::make_shared<RunOptions>();
  auto* command = app.add_subcommand("run", "The whole pipeline: capture a scene, reconstruct, score, report");
  command->add_option("scene", options->scene, "scene file (TOML)")->required();
  add_output(*command, *options, "run folder; default runs/<scene>");
  add_scene_options(*command, *options);
  add_preset(*command, *options);
  add_choices(*command, *options);
  add_threads(*command, *options);
  command->footer(
      "Example:\n  dressform run scenes/library/group1.toml -o runs/group1 --seed 2 --set fuse.voxel_m=0.005\n"
      "  dressform run scenes/library/group1.toml -o runs/thesis1 --preset thesis");
  return [options] { return run_scene_file(*options); };
}

const RegisteredCommand registered_run{10, add_run_command};

}  // namespace
}  // namespace dressform
