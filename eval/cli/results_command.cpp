#include <fmt/format.h>

#include <cstdlib>
#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "eval/report/csv.h"
#include "eval/studies/results_index.h"

namespace dressform {
namespace {

struct ResultsOptions {
  std::vector<std::filesystem::path> folders;
  std::string sql, history, metric;
  bool csv = false;
};

void print_csv(const ResultsIndex::Rows& rows) {
  const auto print_line = [](const std::vector<std::string>& fields) {
    for (std::size_t i = 0; i < fields.size(); ++i) fmt::print("{}{}", i ? "," : "", csv_field(fields[i]));
    fmt::print("\n");
  };
  print_line(rows.columns);
  for (const auto& row : rows.values) print_line(row);
}

void print_aligned(const ResultsIndex::Rows& rows) {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < rows.columns.size(); ++c) {
    widths.push_back(rows.columns[c].size());
    for (const auto& row : rows.values) widths[c] = std::max(widths[c], row[c].size());
  }
  const auto print_line = [&](const std::vector<std::string>& fields) {
    for (std::size_t c = 0; c < fields.size(); ++c) fmt::print("{:<{}}  ", fields[c], widths[c]);
    fmt::print("\n");
  };
  print_line(rows.columns);
  for (const auto& row : rows.values) print_line(row);
}

std::pair<std::string, std::string> stage_and_row(const std::string& option, const std::string& text) {
  const auto space = text.find(' ');
  if (space == text.npos) throw InputError(option + " " + text, "expected stage and row, e.g. \"surface top/f_5mm@1\"");
  return {text.substr(0, space), text.substr(space + 1)};
}

// The values of one row by scene, variant, seed and scale in the order in which they were made, with what changed.
ResultsIndex::Rows history_of(const ResultsIndex& index, const std::string& asked) {
  const auto [stage, metric] = stage_and_row("--history", asked);
  const auto found = index.query(
      "SELECT scene, variant, seed, scale, program, folder, value FROM runs JOIN scores USING (run) "
      "WHERE stage = ? AND metric = ? AND status = 'ok' ORDER BY scene, variant, seed, scale, modified, folder",
      {stage, metric});
  ResultsIndex::Rows rows = found;
  rows.columns.push_back("change");
  for (std::size_t first = 0, last = 0; first < found.values.size(); first = last) {
    std::vector<HistoryPoint> points;
    const auto same = [&](std::size_t i) {
      return std::equal(found.values[i].begin(), found.values[i].begin() + 4, found.values[first].begin());
    };
    for (last = first; last < found.values.size() && same(last); ++last)
      points.push_back({found.values[last][5], found.values[last][4], std::atof(found.values[last][6].c_str())});
    const auto changes = changes_of(points, stage, metric);
    for (std::size_t i = first; i < last; ++i) {
      const Change change = changes[i - first];
      rows.values[i].push_back(change == Change::step ? "STEP" : change == Change::creep ? "CREEP" : "");
    }
  }
  return rows;
}

ResultsIndex::Rows values_of(const ResultsIndex& index, const std::string& asked) {
  const auto [stage, metric] = stage_and_row("--metric", asked);
  return index.query(
      "SELECT scene, variant, seed, scale, value, unit, status, program, folder FROM runs JOIN scores USING (run) "
      "WHERE stage = ? AND metric = ? ORDER BY scene, variant, seed, scale, folder",
      {stage, metric});
}

ResultsIndex::Rows chosen_rows(const ResultsIndex& index, const ResultsOptions& options) {
  if (!options.sql.empty()) return index.query(options.sql);
  if (!options.history.empty()) return history_of(index, options.history);
  if (!options.metric.empty()) return values_of(index, options.metric);
  return index.query(
      "SELECT scene, variant, count(DISTINCT run) AS runs, count(DISTINCT program) AS programs, min(scale) AS "
      "smallest_scale, max(scale) AS largest_scale FROM runs GROUP BY scene, variant ORDER BY scene, variant");
}

int show_results(const ResultsOptions& options) {
  if (!options.sql.empty() + !options.history.empty() + !options.metric.empty() > 1)
    throw InputError("results", "found several questions; expected one of --sql, --metric and --history");
  const ResultsIndex index(options.folders);
  const auto rows = chosen_rows(index, options);
  options.csv ? print_csv(rows) : print_aligned(rows);
  return kSuccess;
}

Command add_results_command(CLI::App& app) {
  auto options = std::make_shared<ResultsOptions>();
  auto* command = app.add_subcommand("results", "Ask the scores of all runs and studies below some folders");
  command->add_option("folders", options->folders, "folders with runs and studies, searched downwards")->required();
  command->add_option("--metric", options->metric, "all values of one row, e.g. \"surface top/f_5mm@1\"");
  command->add_option("--history", options->history,
                      "the same in the order in which they were made, steps and creep beyond nuisance marked");
  command->add_option("--sql", options->sql,
                      "a SELECT over runs(run, kind, folder, scene, variant, seed, scale, program, modified) and "
                      "scores(run, stage, metric, unit, value, status, n_samples)");
  command->add_flag("--csv", options->csv, "comma-separated, for spreadsheets");
  command->footer(
      "Examples:\n  dressform results runs\n  dressform results runs studies --history \"surface top/f_5mm@1\"\n"
      "  dressform results runs --csv --sql \"SELECT scene, avg(value) FROM runs JOIN scores USING (run) WHERE metric "
      "= "
      "'top/f_5mm@1' GROUP BY scene\"");
  return [options] { return show_results(*options); };
}

const RegisteredCommand registered_results{130, add_results_command};

}  // namespace
}  // namespace dressform
