#include <fmt/format.h>

#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/end_to_end_progress.h"
#include "eval/cli/options.h"
#include "eval/figures/write_figures.h"
#include "eval/run/recorded_request.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

struct FiguresOptions : CommonOptions {
  std::vector<fs::path> folders;
  std::vector<std::string> only, formats{"png", "pdf"};
  double dpi = kFigureDpi;
  bool list = false;
};

std::vector<const ThesisFigure*> chosen_figures(const FiguresOptions& options) {
  std::vector<const ThesisFigure*> chosen;
  for (const auto& name : options.only) chosen.push_back(&thesis_figure(name));
  if (chosen.empty())
    for (const auto& figure : thesis_figures_list()) chosen.push_back(&figure);
  return chosen;
}

// Of a run: its stages' results, from its store; what is no longer there is made again.
std::vector<FigureRecord> figures_of_run(const fs::path& run, const FiguresOptions& options, const fs::path& output,
                                         Progress& progress) {
  const EndToEndRequest request = recorded_request(run);
  ArtifactStore store(request.store);
  const SessionSource source = open_session(request.session, false);
  const Reconstruction made = reconstruct(source, request.options, store, end_to_end_progress(progress).stage);
  Renderer renderer;
  const FigureInput input{made, source.session.get(), renderer, request.scene};
  return write_thesis_figures(input, chosen_figures(options), {options.formats, options.dpi}, output);
}

void print_records(const fs::path& output, const std::vector<FigureRecord>& records) {
  for (const auto& record : records)
    if (!record.reason.empty()) fmt::print("  {:<5} {:<24} none: {}\n", record.number, record.name, record.reason);
  const auto made = std::count_if(records.begin(), records.end(), [](const auto& r) { return r.reason.empty(); });
  fmt::print("{}: {} of {} figures\n", output.string(), made, records.size());
}

int list_figures() {
  for (const auto& figure : thesis_figures_list())
    fmt::print("{:<5} {:<24} {:<13} {}{}\n", figure.number, figure.name, figure.stage, figure.shows,
               figure.make ? "" : " (none: " + figure.reason + ")");
  return kSuccess;
}

int figures(const FiguresOptions& options) {
  if (options.list) return list_figures();
  if (options.folders.empty()) throw InputError("figures", "no folder given; expected runs or studies");
  if (options.output.empty()) throw InputError("-o", "missing; expected a folder for the figures");
  chosen_figures(options);  // a wrong name is told before anything is made
  const ThreadLimit threads(options.threads);
  Progress progress(options.quiet);
  for (const auto& folder : options.folders) {
    const std::string name = fs::absolute(folder / "x").lexically_normal().parent_path().filename().string();
    const fs::path output = options.folders.size() == 1 ? options.output : options.output / name;
    if (options.folders.size() > 1) fs::create_directories(options.output);
    const bool study = fs::exists(folder / "study.json");
    print_records(output, study ? write_study_figures(folder, {options.formats, options.dpi}, output)
                                : figures_of_run(folder, options, output, progress));
  }
  return kSuccess;
}

Command add_figures_command(CLI::App& app) {
  auto options = std::make_shared<FiguresOptions>();
  auto* command =
      app.add_subcommand("figures", "The thesis's figures 3.2 to 3.40 and 4.1 to 4.17 of runs; the figures of studies");
  command->add_option("folders", options->folders, "folders of runs or studies");
  command->add_option("-o,--output", options->output,
                      "new folder for the figures (a folder in it for each of several)");
  command->add_option("--only", options->only, "a figure by number or name (repeatable); default: all")
      ->allow_extra_args(false);
  command->add_option("--format", options->formats, "png, pdf, svg, joined by commas (default png,pdf)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(sheet_formats()));
  command->add_option("--dpi", options->dpi, "of PNGs (default 300)")->check(CLI::Range(36, 1200));
  command->add_flag("--list", options->list, "list the figures and what they show");
  add_threads(*command, *options);
  command->footer(
      "Examples:\n  dressform figures runs/group1 -o figures\n"
      "  dressform figures runs/group1 --only 3.40 --format pdf -o resized\n"
      "  dressform figures studies/variants -o figures\n"
      "figures.md in the folder lists every figure with its files, or why there is none.");
  return [options] { return figures(*options); };
}

const RegisteredCommand registered_figures{96, add_figures_command};

}  // namespace
}  // namespace dressform
