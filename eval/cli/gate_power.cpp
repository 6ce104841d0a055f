// `dressform gate power`: what the gate finds of faults whose size is known.
#include <fmt/format.h>

#include <algorithm>

#include "eval/cli/end_to_end_progress.h"
#include "eval/cli/gate_options.h"
#include "eval/gate/power/power_report.h"
#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

void print_library(const std::vector<Fault>& faults) {
  for (const auto& fault : faults) {
    std::string sizes;
    for (const double size : fault.sizes) sizes += fmt::format("{}{:g}", sizes.empty() ? "" : ", ", size);
    fmt::print("{:<34} {:<14} {:<7} {}\n", fault.id(), sizes, fault.unit, fault.what);
  }
  fmt::print("{} faults\n", faults.size());
}

bool wanted_size(const GateOptions& options, const Fault& fault, std::size_t k) {
  return options.sizes.empty() ||
         std::find(options.sizes.begin(), options.sizes.end(), size_word(fault, k)) != options.sizes.end();
}

void run_cells(const PowerBase& base, const std::vector<Fault>& faults, const GateOptions& options, int threads,
               const MeasuredNuisance& nuisance, Progress& progress, std::vector<PowerCell>& cells) {
  const PowerRequest request{options.work / "power", threads};
  int done = 0;
  for (const auto& fault : faults)
    for (std::size_t k = 0; k < fault.sizes.size(); ++k)
      for (int placement = 0; placement < options.placements && wanted_size(options, fault, k); ++placement) {
        const std::string what =
            fmt::format("{}, {} {:g} {} #{}", base.name, fault.id(), fault.sizes[k], fault.unit, placement + 1);
        progress.update(fmt::format("{} ({} done)", what, done++));
        cells.push_back(power_cell(base, fault, k, placement, request, nuisance));
        const PowerCell& cell = cells.back();
        progress.finish(what, cell.found              ? "found; " + cell.worst
                              : cell.by_bytes.empty() ? "no effect"
                                                      : "MISSED; bytes blame " + cell.by_bytes);
      }
}

}  // namespace

int gate_power(const GateOptions& options) {
  const auto faults = chosen_faults(options.faults);
  if (options.dry) {
    print_library(faults);
    return kSuccess;
  }
  for (const auto& word : options.sizes)
    if (word != "small" && word != "medium" && word != "large")
      throw InputError("--sizes " + word, "expected small, medium or large");
  const ThreadLimit threads(options.threads);
  Progress progress(options.quiet);
  try {
    const MeasuredNuisance nuisance = read_nuisance(options.golden).value_or(MeasuredNuisance{});
    std::vector<PowerCell> cells;
    Scores scores;
    for (const auto& name : chosen_cases(options)) {
      const PowerBase base =
          power_base(name, {options.golden, options.work, threads.count(), false}, scene_progress(progress));
      scores = base.run.scores;
      run_cells(base, faults, options, threads.count(), nuisance, progress, cells);
    }
    const auto curves = detection_curves(faults, cells);
    fmt::print("{}\n{}\n{}", curves_text(curves), blame_text(blame_by_bytes(cells), "blame by bytes"),
               blame_text(blame_by_numbers(cells, scores), "blame by numbers and pictures alone"));
    if (!nuisance.usable()) fmt::print("nuisance is declared, not measured: so is the power\n");
    const bool blind = std::any_of(curves.begin(), curves.end(),
                                   [](const auto& curve) { return !curve.sizes.empty() && !curve.size_found; });
    return blind ? kRegression : kSuccess;
  } catch (const GoldenError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return kBadGolden;
  }
}

}  // namespace dressform
