#include <fmt/format.h>

#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/end_to_end_progress.h"
#include "eval/cli/options.h"
#include "eval/report/thesis_tables.h"
#include "eval/run/recorded_request.h"
#include "eval/studies/study_table.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

struct TablesOptions : CommonOptions {
  std::vector<fs::path> runs;
};

std::string name_of(const fs::path& run) {
  fs::path path = fs::absolute(run).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  return path.filename().string();
}

// What the run counts: its stages' results, from its store; what is no longer there is made again.
RunCounts counts_of_run(const fs::path& run, Progress& progress) {
  const EndToEndRequest request = recorded_request(run);
  ArtifactStore store(request.store);
  const Reconstruction made =
      reconstruct(open_session(request.session, false), request.options, store, end_to_end_progress(progress).stage);
  return counts_of(made, name_of(run), request.scene, request.facts.value("scale", 1.0));
}

// Of a study: its variants by every metric.
int tables_of_study(const fs::path& study, const fs::path& output) {
  const StudyResults results = read_results(study);
  const StudyTable table = study_table(results, compare_variants(results));
  fs::create_directories(output);
  write_file_atomically(output / "study.md", study_table_markdown(table));
  write_file_atomically(output / "study.csv", study_table_csv(table));
  write_file_atomically(output / "study.tex", study_table_latex(table));
  write_file_atomically(output / "study.html", study_table_html(table));
  fmt::print("{}\ntables: {}\n", study_table_markdown(table), (output / "study.{md,csv,tex,html}").string());
  return kSuccess;
}

int tables(const TablesOptions& options) {
  const ThreadLimit threads(options.threads);
  const fs::path output = options.output.empty() ? options.runs.front() / "tables" : options.output;
  if (fs::exists(options.runs.front() / "study.json")) {
    if (options.runs.size() > 1)
      throw InputError(options.runs.front().string(), "is a study, found more folders beside it; expected it alone");
    return tables_of_study(options.runs.front(), output);
  }
  Progress progress(options.quiet);
  std::vector<RunCounts> counts;
  for (const fs::path& run : options.runs) counts.push_back(counts_of_run(run, progress));
  const auto made = thesis_tables(counts);
  fs::create_directories(output);
  write_file_atomically(output / "tables.md", tables_markdown(made));
  write_file_atomically(output / "tables.csv", tables_csv(made));
  write_file_atomically(output / "tables.tex", tables_latex(made));
  write_file_atomically(output / "tables.html", tables_html(made));
  fmt::print("{}\ntables: {}\n", tables_markdown(made), (output / "tables.{md,csv,tex,html}").string());
  return kSuccess;
}

Command add_tables_command(CLI::App& app) {
  auto options = std::make_shared<TablesOptions>();
  auto* command =
      app.add_subcommand("tables", "The thesis's tables 4 to 7 and 9 to 15 of runs; of a study its variants");
  command->add_option("run", options->runs, "run folders, in the order of the rows; or one study")->required();
  command->add_option("-o,--output", options->output,
                      "folder for tables.md, .csv, .tex and .html; default tables/ in the first run");
  add_threads(*command, *options);
  command->footer("Example:\n  dressform tables runs/group1 runs/group2 runs/group3 runs/group4 -o tables");
  return [options] { return tables(*options); };
}

const RegisteredCommand registered_tables{95, add_tables_command};

}  // namespace
}  // namespace dressform
