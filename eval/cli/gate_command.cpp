#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <opencv2/imgcodecs.hpp>

#include "eval/cli/commands.h"
#include "eval/cli/end_to_end_progress.h"
#include "eval/cli/options.h"
#include "eval/gate/gate.h"
#include "eval/gate/golden_run.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

struct GateOptions : CommonOptions {
  std::vector<std::string> cases;
  fs::path golden = "golden", work = "runs/gate";
  std::string reason, scene;
  std::vector<std::string> misses;  // "stage metric=why"
};

void keep_images(const GoldenCase& reference, const GoldenRun& run, const fs::path& folder) {
  fs::create_directories(folder);
  for (const auto& [stem, image] : run.images) {
    const auto old = reference.images.find(stem);
    if (old != reference.images.end())
      cv::imwrite((folder / ("new_reference_difference_" + stem + ".png")).string(), flip_image(image, old->second));
  }
}

void print_targets(const GateResult& result) {
  const auto missed = std::count_if(result.targets.begin(), result.targets.end(), [](const auto& t) { return !t.met; });
  fmt::print("  targets: {} of {} met\n", result.targets.size() - missed, result.targets.size());
  for (const auto& target : result.targets) {
    const char* word = target.met ? "met" : target.known.empty() ? "NEWLY MISSED" : "known miss";
    fmt::print("    {:<12} {}: {}, target {} from scale {:g}{}\n", word, target.metric, target.value, target.target,
               target.from_scale, target.known.empty() ? "" : "; " + target.known);
  }
}

void print_accept(const std::string& name, const GateResult& result) {
  std::string misses;
  for (const auto& target : result.targets)
    if (!target.met && target.known.empty()) misses += fmt::format(" --miss \"{}=...\"", target.metric);
  fmt::print("  to accept: dressform gate accept {} --reason \"...\"{}\n", name, misses);
}

ExitCode check_case(const std::string& name, const GateOptions& options, int threads, Progress& progress) {
  const GoldenCase reference = read_golden_case(options.golden, name);
  const GoldenRun run = run_golden_case(reference, options.golden, options.work, threads, scene_progress(progress));
  const GateResult result = compare_with_golden(reference, run.scores, run.images);
  const bool passed = result.verdict == GateVerdict::pass, obsolete = result.verdict == GateVerdict::obsolete;
  if (passed)
    fmt::print("{}: pass, {} compared\n", name, result.compared);
  else
    fmt::print("{}: {}, {} of {}\n", name, obsolete ? "OBSOLETE reference" : "REGRESSION", result.findings.size(),
               result.compared);
  for (const auto& finding : result.findings) fmt::print("  {}: {}\n", finding.what, finding.message);
  for (const auto& finding : result.better) fmt::print("  better, accept me: {}: {}\n", finding.what, finding.message);
  print_targets(result);
  if (!passed) {
    const fs::path kept = options.work / name / "gate";
    keep_images(reference, run, kept);
    fmt::print("  images (new, reference, difference x 10): {}\n", kept.string());
  }
  if (!passed || !result.better.empty()) print_accept(name, result);
  return passed ? kSuccess : obsolete ? kBadGolden : kRegression;
}

int check(const GateOptions& options) {
  const ThreadLimit threads(options.threads);
  Progress progress(options.quiet);
  ExitCode worst = kSuccess;
  try {
    const auto names = options.cases.empty() ? golden_case_names(options.golden) : options.cases;
    for (const auto& name : names) worst = std::max(worst, check_case(name, options, threads.count(), progress));
  } catch (const GoldenError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return kBadGolden;
  }
  return worst;
}

// What was accepted before; a new case when there is none and --scene names its scene.
GoldenCase before(const std::string& name, const GateOptions& options) {
  if (!options.scene.empty() && !fs::exists(options.golden / name / "golden.json")) {
    GoldenCase fresh;
    fresh.name = name;
    fresh.scene = options.scene;
    fresh.scale = options.scale;
    fresh.seed = options.seed;
    return fresh;
  }
  try {
    return read_golden_case(options.golden, name);
  } catch (const GoldenError&) {
    return read_golden_recipe(options.golden, name);  // damaged images: all of it is accepted anew
  }
}

std::map<std::string, std::string> miss_reasons(const GateOptions& options) {
  std::map<std::string, std::string> reasons;
  for (const auto& text : options.misses) {
    const auto at = text.find('=');
    if (at == std::string::npos || at == 0 || at + 1 == text.size())
      throw InputError("--miss " + text, "expected \"stage metric=why\", e.g. \"open top/rims_hd95_mm@1=why\"");
    reasons[text.substr(0, at)] = text.substr(at + 1);
  }
  return reasons;
}

int accept(const GateOptions& options) {
  const auto reasons = miss_reasons(options);
  const ThreadLimit threads(options.threads);
  Progress progress(options.quiet);
  try {
    for (const auto& name : options.cases) {
      const GoldenCase reference = before(name, options);
      const GoldenRun run =
          run_golden_case(reference, options.golden, options.work, threads.count(), scene_progress(progress));
      const GoldenCase next = accepted(reference, run.scores, run.images, options.reason, reasons);
      write_golden_case(options.golden, next);
      fmt::print("{}: accepted; {}\n", name, next.history.back());
    }
  } catch (const GoldenError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return kBadGolden;
  }
  return kSuccess;
}

Command add_gate_command(CLI::App& app) {
  auto options = std::make_shared<GateOptions>();
  auto* command = app.add_subcommand("gate", "Compare runs with the accepted references in golden/");
  command->require_subcommand(1);
  auto* checking = command->add_subcommand("check", "Run the cases and compare; never writes to golden/");
  checking->add_option("cases", options->cases, "cases; default all");
  auto* accepting =
      command->add_subcommand("accept", "Run cases and make what is new or beyond tolerance the reference");
  accepting->add_option("cases", options->cases, "cases")->required();
  accepting->add_option("--reason", options->reason, "why the change is right; kept in the case's history")->required();
  accepting
      ->add_option("--miss", options->misses,
                   "\"stage metric=why\": why a target is missed that no accept explained before (repeatable)")
      ->allow_extra_args(false);
  accepting->add_option("--scene", options->scene, "for a new case: its scene, relative to the folder of golden/");
  add_scene_options(*accepting, *options);
  for (auto* each : {checking, accepting}) {
    each->add_option("--golden", options->golden, "folder of the references (default golden)");
    each->add_option("--work", options->work, "folder for the runs (default runs/gate)");
    add_threads(*each, *options);
  }
  command->footer(
      "Example:\n  dressform gate check group1\n"
      "  dressform gate accept group1 --reason \"new default for surface: rims 2 mm better\"\n"
      "  dressform gate accept group1 --reason \"new scene\" --miss \"open bottom/rims_hd95_mm@1=no view sees the "
      "waist\"");
  return [options, checking] { return checking->parsed() ? check(*options) : accept(*options); };
}

const RegisteredCommand registered_gate{110, add_gate_command};

}  // namespace
}  // namespace dressform
