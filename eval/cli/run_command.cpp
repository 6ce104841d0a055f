#include <fmt/format.h>

#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "eval/cli/road_progress.h"
#include "eval/run/capture_store.h"

namespace dressform {
namespace {

struct RunOptions : CommonOptions {
  std::filesystem::path scene;
};

int run_scene(RunOptions options) {
  const ThreadLimit threads(options.threads);
  const Scene scene = chosen_scene(options.scene, options);
  const Choices choices = parse_choices(options);
  check_options(choices.reconstruction);
  if (options.output.empty()) options.output = std::filesystem::path("runs") / scene.name;
  RunFolder::check(options.output);
  ArtifactStore store(store_folder(options));

  Progress progress(options.quiet);
  const auto capture = stored_capture(scene, options.scale, options.seed, store,
                                      [&](int done, int total, const std::string& what) {
                                        progress.update("synthesize: " + what, done, total);
                                      });
  progress.finish("synthesize (" + scene.sensor_model.variant + ")",
                  capture.reused ? "reused" : seconds_text(capture.seconds) + fmt::format("  {:.0f} MB", capture.peak_memory_mb));

  RoadRunRequest request{capture.session, options.output, store.root(), scene.name, variant_text(options),
                         choices.reconstruction, false, threads.count()};
  request.facts = {{"scene_file", scene.file.string()},
                   {"scene_toml", scene.toml},
                   {"scale", options.scale},
                   {"sensor_model", scene.sensor_model.variant},
                   {"capture", {{"key", capture.recipe.key()}, {"seconds", capture.seconds}, {"peak_memory_mb", capture.peak_memory_mb}}}};
  print_summary(run_road(request, road_progress(progress)));
  return kSuccess;
}

}  // namespace

Command add_run_command(CLI::App& app) {
  auto options = std::make_shared<RunOptions>();
  auto* command = app.add_subcommand("run", "The whole road: capture a scene, reconstruct, score, report");
  command->add_option("scene", options->scene, "scene file (TOML)")->required();
  add_output(*command, *options, "run folder; default runs/<scene>");
  add_scene_options(*command, *options);
  add_choices(*command, *options);
  add_threads(*command, *options);
  command->footer("Example:\n  dressform run scenes/library/group1.toml -o runs/group1 --seed 2 --set fuse.voxel_m=0.005");
  return [options] { return run_scene(*options); };
}

}  // namespace dressform
