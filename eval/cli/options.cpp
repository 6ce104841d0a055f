#include "eval/cli/options.h"

#include <omp.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <thread>

#include "eval/cli/option_fields.h"
#include "eval/run/scene_run.h"
#include "pipeline/run/preset.h"

namespace dressform {
namespace {

std::pair<std::string, std::string> split(const std::string& option, const std::string& text, char at,
                                          const std::string& form) {
  const auto position = text.find(at);
  if (position == std::string::npos || position == 0) throw InputError(option + " " + text, "expected " + form);
  return {text.substr(0, position), text.substr(position + 1)};
}

}  // namespace

void add_output(CLI::App& command, CommonOptions& options, const std::string& what) {
  command.add_option("-o,--output", options.output, what);
  command.add_option(
      "--store", options.store,
      "where stage results are kept and found again; default $DRESSFORM_STORE, or .dressform-store beside "
      "the output folder");
}

void add_threads(CLI::App& command, CommonOptions& options) {
  command.add_option("--threads", options.threads, "number of threads; 0: all cores. Results are the same")
      ->check(CLI::Range(0, 1024));
  command.add_flag("-q,--quiet", options.quiet, "no progress");
}

void add_choices(CLI::App& command, CommonOptions& options) {
  command.add_option("--variant", options.variants, "stage=name: another variant of a stage (repeatable)")
      ->allow_extra_args(false);
  command
      .add_option("--set", options.values, "stage.parameter=value: a parameter (repeatable); see dressform variants")
      ->allow_extra_args(false);
}

void add_preset(CLI::App& command, CommonOptions& options) {
  command.add_option("--preset", options.preset,
                     "variants and parameters by one name, or a TOML file of them; --variant and --set override it; "
                     "see dressform variants --presets");
}

void add_mesh_frame(CLI::App& command, MeshFrame& frame) {
  OptionFields options(command);
  fields(options, frame);
}

void add_scene_options(CLI::App& command, CommonOptions& options) {
  command.add_option("--seed", options.seed, "seed of all noise (default 1)");
  command.add_option("--scale", options.scale, "resolution of all cameras against the scene's, 0.1 to 1 (default 1)")
      ->check(CLI::Range(0.1, 1.0));
}

Choices parse_choices(const CommonOptions& options) {
  Choices choices;
  choices.reconstruction.seed = options.seed;
  if (!options.preset.empty()) {
    Preset preset = read_preset(options.preset);
    choices.reconstruction.variants = std::move(preset.variants);
    choices.reconstruction.values = std::move(preset.values);
  }
  for (const auto& text : options.variants) {
    const auto [stage, name] = split("--variant", text, '=', "stage=name, e.g. registration=point_to_plane");
    if (stage == "sensor")
      choices.sensor.variant = name;
    else
      choose_variant(choices.reconstruction, stage, name);
  }
  for (const auto& text : options.values) {
    const std::string form = "stage.parameter=value, e.g. fuse.voxel_m=0.005";
    const auto [name, value] = split("--set", text, '=', form);
    const auto [stage, parameter] = split("--set", name, '.', form);
    (stage == "sensor" ? choices.sensor.values : choices.reconstruction.values[stage])[parameter] = value;
  }
  return choices;
}

Scene chosen_scene(const std::filesystem::path& file, const CommonOptions& options) {
  Scene scene = scaled(read_scene(file), options.scale);
  choose_sensor(scene, parse_choices(options).sensor);
  return scene;
}

std::string variant_text(const CommonOptions& options) {
  std::vector<std::string> words = options.variants;
  words.insert(words.end(), options.values.begin(), options.values.end());
  std::sort(words.begin(), words.end());
  std::string text = options.preset.empty() ? "" : std::filesystem::path(options.preset).stem().string();
  for (const auto& word : words) text += (text.empty() ? "" : " ") + word;
  return text.empty() ? "default" : text;
}

std::filesystem::path store_folder(const CommonOptions& options) {
  if (!options.store.empty()) return options.store;
  if (const char* store = std::getenv("DRESSFORM_STORE"); store && *store) return store;
  return std::filesystem::absolute(options.output).lexically_normal().parent_path() / ".dressform-store";
}

struct ThreadLimit::Impl {
  explicit Impl(int count) : control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count)) {}
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads)
    : count_(threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))) {
  impl_ = std::make_unique<Impl>(count_);
  omp_set_num_threads(count_);
  cv::setNumThreads(count_);
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace dressform
