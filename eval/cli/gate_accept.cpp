// `dressform gate accept`, `gate list` and `gate doctor`: what looks at the references and writes them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eval/cli/end_to_end_progress.h"
#include "eval/cli/gate_options.h"
#include "eval/gate/accept.h"
#include "eval/gate/doctor.h"
#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// What was accepted before; a new case when there is none and --scene names its scene.
GoldenCase accepted_before(const std::string& name, const GateOptions& options) {
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
    if (!options.items.empty()) throw;                // a part can be accepted only of what is whole
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

// The identity of the run that the last check showed; empty where there was none.
std::string checked_identity(const fs::path& folder) {
  return fs::exists(folder / "observed.json") ? read_golden_run(folder).identity() : std::string();
}

// The run that was checked: nothing is made again. Another one is not accepted unseen.
GoldenRun checked_run(const GoldenCase& reference, const GateOptions& options, int threads, Progress& progress) {
  const std::string seen = checked_identity(observed_folder(options.work, reference.name));
  const GoldenRun run =
      run_golden_case(reference, {options.golden, options.work, threads, false}, scene_progress(progress));
  if (!seen.empty() && seen != run.identity())
    throw InputError(reference.name,
                     "found another run than the one that was checked (program, scene or environment "
                     "changed since); expected `dressform gate check " +
                         reference.name + "` first, to see what is accepted");
  return run;
}

double largest_drift(const GoldenCase& golden, std::string& name) {
  double largest = 0;
  for (const auto& score : golden.scores) {
    if (!std::isfinite(score.first) || !std::isfinite(score.row.value) || score.tolerance <= 0) continue;
    const double drift = worsening(score.row, score.first, score.row.value) / score.tolerance;
    if (drift > largest) largest = drift, name = score.row.stage + " " + score.row.metric;
  }
  return largest;
}

void print_case(const GoldenCase& golden) {
  fmt::print("{}: {}, scale {:g}, seed {}; {} numbers, {} images, {} known misses, {} accepts\n", golden.name,
             golden.scene, golden.scale, golden.seed, golden.scores.size(), golden.images.size(),
             golden.known_misses.size(), golden.history.size());
  if (golden.steps.empty()) {
    fmt::print("  no bytes kept: accept to keep them\n");
  } else {
    const std::string difference = environment_difference(golden.environment, this_environment());
    fmt::print("  bytes of {} steps, {}\n", golden.steps.size(),
               difference.empty() ? "made in this environment" : "made in another environment: " + difference);
  }
  std::string crept;
  if (const double drift = largest_drift(golden, crept); drift > 0)
    fmt::print("  largest drift since first accepted: {}, {:.1f} tolerances\n", crept, drift);
  for (const auto& [stem, drift] : golden.image_drift)
    fmt::print("  image {}: FLIP {:.4f} over all accepts\n", stem, drift);
  if (!golden.history.empty()) fmt::print("  last: {}\n", golden.history.back());
}

}  // namespace

int gate_accept(const GateOptions& options) {
  const auto reasons = miss_reasons(options);
  const ThreadLimit threads(options.threads);
  Progress progress(options.quiet);
  try {
    const MeasuredNuisance nuisance = read_nuisance(options.golden).value_or(MeasuredNuisance{});
    for (const auto& name : options.cases) {
      const GoldenCase reference = accepted_before(name, options);
      const GoldenRun run = checked_run(reference, options, threads.count(), progress);
      const Accepted next = accepted(reference, run, {options.reason, options.items, reasons}, nuisance);
      write_golden_case(options.golden, next.golden);
      fmt::print("{}: accepted; {}\n", name, next.golden.history.back());
      for (const auto& item : next.left)
        fmt::print("  left as it was: {} crept too far to be accepted with the rest; if that is right: --item \"{}\"\n",
                   item, item);
      if (next.golden.steps.empty()) fmt::print("  no bytes kept: not all of the run is accepted\n");
    }
  } catch (const GoldenError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return kBadGolden;
  }
  return kSuccess;
}

int gate_list(const GateOptions& options) {
  try {
    for (const auto& name : chosen_cases(options)) print_case(read_golden_case(options.golden, name));
  } catch (const GoldenError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return kBadGolden;
  }
  return kSuccess;
}

int gate_doctor(const GateOptions& options) {
  const auto complaints = examine_goldens(options.golden);
  for (const auto& each : complaints) fmt::print("{} {}: {}\n", each.grave ? "GRAVE" : "note ", each.where, each.what);
  const bool grave = std::any_of(complaints.begin(), complaints.end(), [](const auto& each) { return each.grave; });
  if (!grave) fmt::print("the references of {} can be relied on\n", options.golden.string());
  return grave ? kBadGolden : kSuccess;
}

}  // namespace dressform
