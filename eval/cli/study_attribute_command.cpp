#include <fmt/format.h>

#include <memory>
#include <sstream>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "eval/cli/progress.h"
#include "eval/studies/attribution.h"
#include "eval/studies/make_cell.h"
#include "eval/studies/run_cells.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

struct AttributeOptions : CommonOptions {
  std::string a, b;
  std::vector<fs::path> scenes;
  std::vector<std::string> metrics;
  std::vector<Seed> seeds{1};
};

const char* const kUsualMetrics[] = {"surface <slot>/f_5mm@1", "open <slot>/rims_hd95_mm@1",
                                     "texture <slot>/ssim_observed@2", "registration max/tre_mm@1"};

// "thesis", "mine.toml", "default", "surface=poisson fuse.voxel_m=0.003", or a preset with what overrides it.
ReconstructionOptions side_of(const std::string& where, const std::string& text) {
  CommonOptions options;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const auto equals = word.find('=');
    if (equals == word.npos) {
      if (!options.preset.empty())
        throw InputError(where + " " + text,
                         "found two presets; expected one, and stage=variant or stage.parameter=value");
      options.preset = word;
    } else if (word.find('.') < equals) {
      options.values.push_back(word);
    } else {
      options.variants.push_back(word);
    }
  }
  const Choices choices = parse_choices(options);
  if (!choices.sensor.variant.empty() || !choices.sensor.values.empty())
    throw InputError(where + " " + text, "found a sensor model; expected stages of the pipeline, on the same captures");
  check_options(choices.reconstruction);
  return choices.reconstruction;
}

Study study_of(const AttributeOptions& options, const AttributionStudy& swaps) {
  Study study;
  study.name = "attribution";
  study.description = fmt::format("A: {}. B: {}.", options.a, options.b);
  study.scale = options.scale;
  study.seeds = options.seeds;
  study.baseline = "A";
  study.variants = swaps.variants;
  for (const auto& scene : options.scenes)
    (fs::is_directory(scene) ? study.recordings : study.scenes).push_back(fs::absolute(scene));
  if (options.metrics.empty())
    for (const char* metric : kUsualMetrics) study.metrics.push_back(study_metric("--metric", metric));
  for (const auto& metric : options.metrics) study.metrics.push_back(study_metric("--metric", metric));
  return study;
}

int attribute(const AttributeOptions& options) {
  const AttributionStudy swaps = attribution_of(side_of("A", options.a), side_of("B", options.b));
  const std::string written =
      fmt::format("# dressform study attribute \"{}\" \"{}\" ...: study.json holds it whole\n", options.a, options.b);
  const StudyPlan plan = plan_study(study_of(options, swaps), written, options.output);
  fmt::print("{} stages differ: {}; {} variants on {} scenes\n", swaps.stages.size(), fmt::join(swaps.stages, ", "),
             swaps.variants.size(), plan.scenes.size());
  const ThreadLimit threads(options.threads);
  Progress progress(options.quiet);
  RunCellsProgress shown;
  shown.begin = [&](const PlannedCell& cell, int done, int total, double) {
    progress.update(fmt::format("{} of {} cells; {}: {}", done, total, plan.scenes[cell.scene].name,
                                plan.study.variants[cell.variant].name));
  };
  shown.end = [&](const PlannedCell& cell, const MadeCell& made, double seconds) {
    progress.finish(plan.scenes[cell.scene].name + ": " + plan.study.variants[cell.variant].name,
                    made.result.failed ? "FAILED: " + made.result.reason : seconds_text(seconds));
  };
  RunCellsRequest request;
  request.folder = options.output;
  request.signature = program_signature();
  run_cells(plan, request, pipeline_cells(options.output, store_folder(options), threads.count()), shown);
  const StudyResults results = read_results(options.output);
  const auto parts = attributions(results, swaps.stages);
  const std::string text = attribution_markdown(results, parts);
  write_file_atomically(options.output / "attribution.md", text);
  write_file_atomically(options.output / "attribution.csv", attribution_csv(parts));
  fmt::print("{}\n", text);
  return kSuccess;
}

Command add_study_attribute_command(CLI::App& study) {
  auto options = std::make_shared<AttributeOptions>();
  auto* command =
      study.add_subcommand("attribute", "Say which stages a change of the end scores from A to B comes from");
  command->add_option("a", options->a, "preset, preset file, or \"stage=variant stage.parameter=value\"")->required();
  command->add_option("b", options->b, "likewise")->required();
  command->add_option("scenes", options->scenes, "scene files, or recordings (folders)")->required();
  command->add_option("-o,--output", options->output, "the study's folder; a killed run goes on where it was")
      ->required();
  command->add_option("--metric", options->metrics, "\"stage row\" (repeatable); default: surface, rims, print, poses")
      ->allow_extra_args(false);
  command->add_option("--seeds", options->seeds, "1,2,3: seeds of all noise (1)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--scale", options->scale, "resolution of all cameras (1)")->check(CLI::Range(0.1, 1.0));
  command->add_option("--store", options->store, "where stage results are shared");
  add_threads(*command, *options);
  command->footer(
      "Example:\n  dressform study attribute default thesis scenes/library/group1.toml -o studies/where --scale 0.6");
  return [options] { return attribute(*options); };
}

const RegisteredStudyCommand registered_study_attribute{20, add_study_attribute_command};

}  // namespace
}  // namespace dressform
