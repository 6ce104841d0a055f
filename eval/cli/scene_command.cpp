#include <fmt/format.h>

#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/option_fields.h"
#include "eval/cli/options.h"
#include "eval/studies/draw/draw_scene.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

struct SceneDrawOptions {
  DrawOptions draw;
  Seed seed = 1;
  int count = 1;
  std::filesystem::path output;
};

int draw_scenes(const SceneDrawOptions& options) {
  if (options.count == 1) {
    write_file_atomically(options.output, scene_toml(draw_scene(options.draw, options.seed)));
    return kSuccess;
  }
  std::filesystem::create_directories(options.output);
  for (int i = 0; i < options.count; ++i) {
    const DrawnScene scene = draw_scene(options.draw, options.seed + static_cast<Seed>(i));
    write_file_atomically(options.output / (scene.name + ".toml"), scene_toml(scene));
  }
  return kSuccess;
}

Command add_scene_command(CLI::App& app) {
  auto options = std::make_shared<SceneDrawOptions>();
  auto* command = app.add_subcommand("scene", "Draw scenes by seed: people, clothes, rooms and rigs as they differ");
  command->require_subcommand(1);
  auto* draw = command->add_subcommand("draw", "A scene file drawn by seed; the same seed gives the same file");
  draw->add_option("--seed", options->seed, "number of the scene (default 1)");
  draw->add_option("-o,--output", options->output, "the scene file; with --count a folder for the files")->required();
  draw->add_option("--count", options->count, "how many, from --seed on (default 1)")->check(CLI::Range(1, 100000));
  OptionFields draw_options(*draw);
  fields(draw_options, options->draw);
  std::string strata;
  for (const auto& stratum : known_strata()) strata += fmt::format("\n  {:<14} {}", stratum.name, stratum.meaning);
  draw->add_option("--stratum", options->draw.strata, "the scene has this, see below (repeatable)")
      ->allow_extra_args(false);
  draw->footer("Strata:" + strata +
               "\nExamples:\n  dressform scene draw --seed 7 -o scene.toml\n"
               "  dressform scene draw --seed 7 --stratum skirt --stratum three_sensors -o scene.toml\n"
               "  dressform scene draw --seed 100 --count 24 -o scenes/");
  command->footer(draw->get_footer());
  return [options] { return draw_scenes(*options); };
}

const RegisteredCommand registered_scene{15, add_scene_command};

}  // namespace
}  // namespace dressform
