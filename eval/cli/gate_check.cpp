// `dressform gate check` and `gate run`.
#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <thread>

#include "eval/cli/end_to_end_progress.h"
#include "eval/cli/gate_options.h"
#include "eval/gate/accept.h"
#include "eval/gate/junit.h"
#include "eval/run/child_process.h"
#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBetter = 12;      // of the lines that ask to be accepted; all are in --junit
constexpr double kLimitMinutesOfACase = 60;  // a case that runs longer beside others hangs

void keep_strips(const GoldenCase& reference, const GoldenRun& run, const fs::path& folder) {
  fs::create_directories(folder);
  for (const auto& [stem, image] : run.images) {
    const auto old = reference.images.find(stem);
    if (old != reference.images.end())
      cv::imwrite((folder / ("new_reference_difference_" + stem + ".png")).string(),
                  comparison_strip(image, old->second));
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

void print_stages(const GateResult& result) {
  for (const auto& stage : result.stages) {
    std::string counts;
    for (const auto& [verdict, count] : stage.counts)
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, verdict_word(verdict));
    fmt::print("  {:<13} {:<16} {}\n", stage.stage, verdict_word(stage.verdict), counts);
  }
}

void print_accept(const std::string& name, const GateResult& result) {
  std::string misses, items;
  for (const auto& target : result.targets)
    if (!target.met && target.known.empty()) misses += fmt::format(" --miss \"{}=...\"", target.metric);
  for (const auto& finding : result.findings)
    if (finding.verdict == ItemVerdict::creep) items += fmt::format(" --item \"{}\"", finding.what());
  fmt::print("  to accept: dressform gate accept {} --reason \"...\"{}\n", name, misses);
  if (!items.empty())
    fmt::print("  what crept is accepted by name: dressform gate accept {} --reason \"...\"{}\n", name, items);
}

void print_result(const std::string& name, const GateResult& result) {
  const bool passed = result.verdict == GateVerdict::pass, obsolete = result.verdict == GateVerdict::obsolete;
  const std::string bytes = bytes_text(result.bytes);
  if (passed)
    fmt::print("{}: pass, {}; {} compared\n", name, bytes, result.compared);
  else
    fmt::print("{}: {}, {} of {}; {}\n", name, obsolete ? "OBSOLETE reference" : "REGRESSION", result.findings.size(),
               result.compared, bytes);
  if (!passed && !result.blame.empty())
    fmt::print("  begins at {}{}\n", result.blame,
               result.bytes.state == BytesState::changed ? "" : ", the first stage whose numbers fail");
  const bool all_same = passed && result.bytes.state == BytesState::identical;
  if (!all_same) print_stages(result);
  for (const auto& finding : result.findings)
    fmt::print("  {}: {}: {}\n", verdict_word(finding.verdict), finding.what(), finding.message);
  for (std::size_t k = 0; k < std::min(kMostBetter, result.better.size()); ++k)
    fmt::print("  better, accept me: {}: {}\n", result.better[k].what(), result.better[k].message);
  if (result.better.size() > kMostBetter) fmt::print("  and {} more better\n", result.better.size() - kMostBetter);
  if (!result.unmeasured.empty())
    fmt::print("  nuisance is declared, not measured, for {} metrics\n", result.unmeasured.size());
  print_targets(result);
}

// The report of a run that failed, for who has to look at it; of all stages nothing is made again.
void make_report(const GoldenCase& reference, const GateOptions& options, int threads, Progress& progress) {
  run_golden_case(reference, {options.golden, options.work, threads, true}, scene_progress(progress));
  fmt::print("  report: {}\n", (options.work / reference.name / "report.html").string());
}

ExitCode check_case(const std::string& name, const GateOptions& options, const MeasuredNuisance& nuisance, int threads,
                    Progress& progress, CheckedCase& checked) {
  const GoldenCase reference = read_golden_case(options.golden, name);
  const GoldenRun run =
      run_golden_case(reference, {options.golden, options.work, threads, false}, scene_progress(progress));
  const GateResult result = checked.result = compare_with_golden(reference, run, nuisance);
  print_result(name, result);
  const bool passed = result.verdict == GateVerdict::pass;
  if (!passed) {
    const fs::path kept = observed_folder(options.work, name);
    keep_strips(reference, run, kept);
    fmt::print("  images (new, reference, difference x 10): {}\n", kept.string());
    make_report(reference, options, threads, progress);
  }
  if (!passed || !result.better.empty()) print_accept(name, result);
  return passed ? kSuccess : result.verdict == GateVerdict::obsolete ? kBadGolden : kRegression;
}

// Runs all cases but the first beforehand, several at a time, each in a process of its own; what they made lies in the
// store then. A case that fails there fails again, with its reason, when it is checked.
void run_beside(const std::vector<std::string>& cases, const GateOptions& options, int threads) {
  const std::string self = fs::read_symlink("/proc/self/exe").string();
  const int each = std::max(1, threads / options.jobs);
  fs::create_directories(options.work);
  std::vector<std::thread> workers;
  for (int worker = 0; worker < options.jobs; ++worker)
    workers.emplace_back([&, worker] {
      for (std::size_t k = 1 + worker; k < cases.size(); k += options.jobs) {
        const std::string line =
            fmt::format("{} gate run {} --golden {} --work {} --threads {} -q", shell_word(self), shell_word(cases[k]),
                        shell_word(options.golden.string()), shell_word(options.work.string()), each);
        run_child({line, fs::current_path(), 60 * kLimitMinutesOfACase, options.work / (cases[k] + ".out"),
                   options.work / (cases[k] + ".log")});
      }
    });
  for (auto& worker : workers) worker.join();
}

MeasuredNuisance known_nuisance(const GateOptions& options) {
  return read_nuisance(options.golden).value_or(MeasuredNuisance{});
}

}  // namespace

int gate_check(const GateOptions& options) {
  const ThreadLimit threads(options.threads);
  Progress progress(options.quiet);
  ExitCode worst = kSuccess;
  std::vector<CheckedCase> checked;
  try {
    const auto names = chosen_cases(options);
    const MeasuredNuisance nuisance = known_nuisance(options);
    for (const auto& name : names) {
      checked.push_back({name, {}, ""});
      try {
        worst = std::max(worst, check_case(name, options, nuisance, threads.count(), progress, checked.back()));
      } catch (const GoldenError& error) {
        checked.back().error = error.what();
        fmt::print(stderr, "error: {}\n", error.what());
        worst = std::max(worst, kBadGolden);
      } catch (const InputError&) {
        throw;  // what the caller got wrong ends the check
      } catch (const std::exception& error) {
        checked.back().error = fmt::format("the run crashed: {}", error.what());
        fmt::print(stderr, "{}: crash: {}\n", name, error.what());
        worst = std::max(worst, kCrash);
      }
      if (checked.size() == 1 && names.size() > 1 && options.jobs > 1) run_beside(names, options, threads.count());
    }
  } catch (const GoldenError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    checked.push_back({"golden", {}, error.what()});
    worst = std::max(worst, kBadGolden);
  }
  if (!options.junit.empty()) write_junit(options.junit, checked);
  return worst;
}

int gate_run(const GateOptions& options) {
  const ThreadLimit threads(options.threads);
  Progress progress(options.quiet);
  try {
    for (const auto& name : chosen_cases(options)) {
      const GoldenCase recipe = read_golden_recipe(options.golden, name);
      const GoldenRun run =
          run_golden_case(recipe, {options.golden, options.work, threads.count(), false}, scene_progress(progress));
      fmt::print("{}: {}\n", name, run.identity());
    }
  } catch (const GoldenError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return kBadGolden;
  }
  return kSuccess;
}

}  // namespace dressform
