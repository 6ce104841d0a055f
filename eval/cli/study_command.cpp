#include <fmt/format.h>

#include <memory>
#include <set>
#include <thread>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "eval/cli/progress.h"
#include "eval/cli/study_workers.h"
#include "eval/studies/make_cell.h"
#include "eval/studies/merge.h"
#include "eval/studies/study_report.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

struct StudyOptions : CommonOptions {
  fs::path study;  // the study file, or the folder that it was planned into
  std::vector<std::string> cells;
  std::vector<fs::path> others;
  std::string part;
  int workers = 0;
  bool retry_failed = false, renew = false, keep = false, missing = false, by_scene = false, without_seconds = false;
};

int new_study(const StudyOptions& options) {
  const StudyPlan plan = plan_study(options.study, options.output);
  fmt::print("{}: {} scenes, {} variants, {} seeds, {} cells\nnext: dressform study run {}\n", options.output.string(),
             plan.scenes.size(), plan.study.variants.size(), plan.study.seeds.size(),
             cells_of(plan, options.output).size(), options.output.string());
  return kSuccess;
}

std::string time_text(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  return seconds < 5400 ? fmt::format("{:.0f} min", seconds / 60) : fmt::format("{:.1f} h", seconds / 3600);
}

std::string cell_text(const StudyPlan& plan, const PlannedCell& cell) {
  return fmt::format("{}, seed {}: {}", plan.scenes[cell.scene].name, cell.seed,
                     plan.study.variants[cell.variant].name);
}

RunCellsProgress cell_progress(const StudyPlan& plan, Progress& progress) {
  RunCellsProgress result;
  result.begin = [&](const PlannedCell& cell, int done, int total, double left) {
    const std::string eta = left < 0 ? "" : ", about " + time_text(left) + " left";
    progress.update(fmt::format("{} of {} cells{}; {}", done, total, eta, cell_text(plan, cell)));
  };
  result.end = [&](const PlannedCell& cell, const MadeCell& made, double seconds) {
    progress.finish(cell_text(plan, cell),
                    made.result.failed ? "FAILED: " + made.result.reason : seconds_text(seconds));
  };
  return result;
}

// "2/5": the second of five shares of the scenes.
std::vector<std::string> cells_of_part(const StudyPlan& plan, const fs::path& folder, const std::string& part) {
  std::size_t share = 0, shares = 0;
  char rest = 0;
  if (std::sscanf(part.c_str(), "%zu/%zu%c", &share, &shares, &rest) != 2 || share < 1 || share > shares)
    throw InputError("--part " + part, "expected K/N with K from 1 to N, e.g. 2/5");
  std::vector<std::string> ids;
  for (const auto& cell : cells_of(plan, folder))
    if (cell.scene % shares == share - 1) ids.push_back(cell.id);
  return ids;
}

fs::path planned_folder(const StudyOptions& options) {
  if (!fs::is_regular_file(options.study)) return options.study;
  if (options.output.empty())
    throw InputError("-o", "missing; expected the folder of the study, or a folder that `dressform study new` made");
  plan_study(options.study, options.output);
  return options.output;
}

int core_count(int threads) {
  return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// Processes that share the scenes. Cells that are asked for one by one, or made once more, are one process's work:
// nobody could tell what another one has made again already.
int workers_of(const StudyOptions& options, const StudyPlan& plan) {
  if (options.workers == 1 || !options.cells.empty() || options.retry_failed || options.renew) return 1;
  std::set<std::pair<std::size_t, Seed>> left;
  for (const auto& cell : cells_of(plan, options.output))
    if (!fs::exists(cell_file(options.output, cell.id))) left.insert({cell.scene, cell.seed});
  if (options.workers > 0) return std::min(options.workers, std::max(1, static_cast<int>(left.size())));
  return worth_while_workers(core_count(options.threads), left.size());
}

std::vector<std::string> worker_arguments(const StudyOptions& options, int threads) {
  std::vector<std::string> arguments{"study",
                                     "run",
                                     fs::absolute(options.output).string(),
                                     "-q",
                                     "--workers",
                                     "1",
                                     "--threads",
                                     std::to_string(threads),
                                     "--store",
                                     fs::absolute(store_folder(options)).string()};
  if (options.keep) arguments.push_back("--keep");
  return arguments;
}

int run_study(StudyOptions options) {
  const fs::path folder = options.output = planned_folder(options);
  const StudyPlan plan = read_plan(folder);
  if (!options.part.empty() && !options.cells.empty())
    throw InputError("--part " + options.part, "found it beside --cell; expected one of the two");
  if (!options.part.empty()) options.cells = cells_of_part(plan, folder, options.part);
  const int workers = workers_of(options, plan);
  const ThreadLimit threads(std::max(1, core_count(options.threads) / workers));
  Progress progress(options.quiet);
  RunCellsRequest request{folder,        options.cells, program_signature(), options.retry_failed,
                          options.renew, options.keep};
  if (!options.part.empty() && options.cells.empty()) return kSuccess;  // more shares than scenes
  request.durable = true;
  request.workers = workers;
  const StudyWorkers others(workers - 1, worker_arguments(options, threads.count()), folder);
  const auto summary = run_cells(plan, request, pipeline_cells(folder, store_folder(options), threads.count()),
                                 cell_progress(plan, progress));
  if (workers > 1)
    fmt::print("all cells are there; {} were before\n", summary.present);
  else if (summary.made == 0)
    fmt::print("nothing to do: {} cells are there\n", summary.present);
  else
    fmt::print("{} cells made, {} of them failed; {} were there\n", summary.made, summary.failed, summary.present);
  fmt::print("next: dressform study report {}\n", folder.string());
  return kSuccess;
}

std::vector<PlannedCell> missing_cells(const StudyOptions& options, const StudyPlan& plan) {
  std::vector<PlannedCell> cells;
  std::set<std::string> seen;
  for (const auto& cell : cells_of(plan, options.study)) {
    const bool there = options.missing && fs::exists(cell_file(options.study, cell.id));
    if (!there && seen.insert(cell.id).second) cells.push_back(cell);
  }
  return cells;
}

int list_cells(const StudyOptions& options) {
  const StudyPlan plan = read_plan(options.study);
  const std::string store = options.store.empty() ? "" : " --store " + options.store.string();
  const std::string start = fmt::format("dressform study run {}{} -q", options.study.string(), store);
  const auto cells = missing_cells(options, plan);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool joined = options.by_scene && i > 0 && cells[i].scene == cells[i - 1].scene;
    if (!joined) fmt::print("{}{}", i > 0 ? "\n" : "", start);
    fmt::print(" --cell {}", cells[i].id);
  }
  if (!cells.empty()) fmt::print("\n");
  return kSuccess;
}

int show_status(const StudyOptions& options) {
  const StudyPlan plan = read_plan(options.study);
  const auto planned = cells_of(plan, options.study);
  struct Count {
    int done = 0, failed = 0, total = 0;
  };
  std::vector<Count> counts(plan.study.variants.size());
  Count all;
  for (const auto& cell : planned) {
    const fs::path file = cell_file(options.study, cell.id);
    Count& count = counts[cell.variant];
    ++count.total, ++all.total;
    if (!fs::exists(file)) continue;
    const CellResult result = read_cell(file);
    ++count.done, ++all.done;
    count.failed += result.failed, all.failed += result.failed;
    if (result.failed) fmt::print("failed  {}  {}: {}\n", cell.id, cell_text(plan, cell), result.reason);
  }
  for (std::size_t v = 0; v < counts.size(); ++v)
    fmt::print("{:<40} {:>5} of {:<5} {}\n", plan.study.variants[v].name, counts[v].done, counts[v].total,
               counts[v].failed ? fmt::format("{} failed", counts[v].failed) : "");
  fmt::print("{}: {} of {} cells, {} failed\n", plan.study.name, all.done, all.total, all.failed);
  return kSuccess;
}

int report_study(const StudyOptions& options) {
  const WrittenReport report = write_study_report(options.study, !options.without_seconds);
  fmt::print("{}\n", report.headline);
  for (const auto& file : report.files) fmt::print("{}\n", file.string());
  return kSuccess;
}

int merge_study(const StudyOptions& options) {
  const auto summary = merge_studies(options.study, options.others);
  fmt::print("{} cells taken, {} were there\n", summary.taken, summary.known);
  return kSuccess;
}

using Action = int (*)(const StudyOptions&);
int run_action(const StudyOptions& options) { return run_study(options); }

void add_run_options(CLI::App& run, StudyOptions& options) {
  run.add_option("-o,--output", options.output, "for a study file: the folder that it is planned into");
  run.add_option("--cell", options.cells, "only this cell (repeatable)")->allow_extra_args(false);
  run.add_option("--part", options.part, "K/N: only the K-th of N shares of the scenes");
  run.add_option("--workers", options.workers,
                 "processes that share the scenes, and --threads among them; default: one a core, as memory allows")
      ->check(CLI::Range(1, 1024));
  run.add_flag("--retry-failed", options.retry_failed, "make failed cells once more");
  run.add_flag("--renew", options.renew, "make cells of other programs anew; otherwise they are an error");
  run.add_flag("--keep", options.keep, "keep each cell's run (out/, scores) in work/<cell id>");
  add_threads(run, options);
}

Command add_study_command(CLI::App& app) {
  auto options = std::make_shared<StudyOptions>();
  auto* command = app.add_subcommand("study", "Compare variants on many scenes and seeds, and say how sure it is");
  command->require_subcommand(1);
  auto actions = std::make_shared<std::vector<std::pair<CLI::App*, Action>>>();
  const auto add = [&](const char* name, const char* what, Action action, const char* study) {
    auto* sub = command->add_subcommand(name, what);
    sub->add_option("study", options->study, study)->required();
    actions->push_back({sub, action});
    return sub;
  };
  const char* folder = "folder made by `study new`";
  add("new", "Plan a study: check all of it, draw its scenes, write the folder", new_study, "study file (TOML)")
      ->add_option("-o,--output", options->output, "the study's folder")
      ->required();
  auto* run = add("run", "Make the cells that are missing; a killed run goes on where it was", run_action,
                  "folder made by `study new`, or a study file with -o");
  add_run_options(*run, *options);
  auto* cells = add("cells", "Print one command a cell, for GNU parallel, Slurm arrays, make", list_cells, folder);
  cells->add_flag("--missing", options->missing, "only cells that are not there yet");
  cells->add_flag("--by-scene", options->by_scene, "one command a scene: its variants share what lies before them");
  for (auto* each : {run, cells})
    each->add_option("--store", options->store,
                     "where stage results are shared; default $DRESSFORM_STORE, or .dressform-store beside the folder");
  add("status", "How many cells are there, and what failed why", show_status, folder);
  add("report", "Write report.md, report.html, results.csv, comparisons.csv", report_study, folder)
      ->add_flag("--without-seconds", options->without_seconds, "leave out what is never the same twice");
  add("merge", "Take the cells that other machines made of the same study", merge_study, folder)
      ->add_option("others", options->others, "their folders")
      ->required();
  command->footer(
      "Examples:\n  dressform study new scenes/library/studies/variants.toml -o studies/variants\n"
      "  dressform study run studies/variants\n  dressform study report studies/variants\n"
      "  dressform study cells studies/variants --by-scene | parallel -j 4\n"
      "A study file is described in eval/studies/README.md.");
  auto others = std::make_shared<std::vector<std::pair<CLI::App*, Command>>>();  // of files of their own
  for (const AddCommand add_other : registered_study_commands()) {
    Command other = add_other(*command);
    others->push_back({command->get_subcommands({}).back(), std::move(other)});
  }
  return [options, actions, others] {
    for (const auto& [sub, action] : *actions)
      if (sub->parsed()) return action(*options);
    for (const auto& [sub, other] : *others)
      if (sub->parsed()) return other();
    return static_cast<int>(kBadInput);
  };
}

const RegisteredCommand registered_study{120, add_study_command};

}  // namespace
}  // namespace dressform
