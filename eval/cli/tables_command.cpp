#include <fmt/format.h>

#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/end_to_end_progress.h"
#include "eval/cli/options.h"
#include "eval/report/thesis_tables.h"
#include "eval/run/recorded_request.h"
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

int tables(const TablesOptions& options) {
  const ThreadLimit threads(options.threads);
  const fs::path output = options.output.empty() ? options.runs.front() / "tables" : options.output;
  Progress progress(options.quiet);
  std::vector<RunCounts> counts;
  for (const fs::path& run : options.runs) counts.push_back(counts_of_run(run, progress));
  const auto made = thesis_tables(counts);
  fs::create_directories(output);
  write_file_atomically(output / "tables.md", tables_markdown(made));
  write_file_atomically(output / "tables.csv", tables_csv(made));
  write_file_atomically(output / "tables.tex", tables_latex(made));
  fmt::print("{}\ntables: {}\n", tables_markdown(made), (output / "tables.{md,csv,tex}").string());
  return kSuccess;
}

Command add_tables_command(CLI::App& app) {
  auto options = std::make_shared<TablesOptions>();
  auto* command =
      app.add_subcommand("tables", "The thesis's tables 4 to 7 and 9 to 15 of runs, beside its own figures");
  command->add_option("run", options->runs, "run folders, in the order of the rows")->required();
  command->add_option("-o,--output", options->output,
                      "folder for tables.md, tables.csv and tables.tex; default tables/ in the first run");
  add_threads(*command, *options);
  command->footer("Example:\n  dressform tables runs/group1 runs/group2 runs/group3 runs/group4 -o tables");
  return [options] { return tables(*options); };
}

const RegisteredCommand registered_tables{95, add_tables_command};

}  // namespace
}  // namespace dressform
