#include <fmt/format.h>

#include <memory>

#include "eval/cli/commands.h"
#include "eval/cli/options.h"
#include "eval/report/metric_tables.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

struct MetricsOptions {
  std::string stage, format = "markdown";
  std::vector<std::filesystem::path> documents;
};

int list_metrics(const MetricsOptions& options) {
  std::vector<std::string> rewritten;  // all of them before the first is written
  for (const auto& file : options.documents)
    rewritten.push_back(with_metric_tables(read_file_bytes(file), file.string()));
  for (std::size_t i = 0; i < rewritten.size(); ++i) write_file_atomically(options.documents[i], rewritten[i]);
  if (!rewritten.empty()) return kSuccess;
  const auto metrics = metrics_of(options.stage);
  fmt::print("{}", options.format == "csv"    ? metrics_csv(metrics)
                   : options.format == "json" ? metrics_json(metrics)
                                              : metrics_markdown(metrics));
  return kSuccess;
}

Command add_metrics_command(CLI::App& app) {
  auto options = std::make_shared<MetricsOptions>();
  auto* command = app.add_subcommand("metrics", "List what scores measure: unit, direction, target, definition, paper");
  command->add_option("stage", options->stage, "only this stage");
  command->add_option("--format", options->format, "markdown (default), csv or json")
      ->check(CLI::IsMember({"markdown", "csv", "json"}));
  command->add_option("--write", options->documents,
                      "write the tables between <!-- metrics --> and <!-- /metrics --> of these documents anew");
  command->footer(
      "Examples:\n  dressform metrics surface\n  dressform metrics --format csv > metrics.csv\n"
      "  dressform metrics --write README.md --write eval/README.md");
  return [options] { return list_metrics(*options); };
}

const RegisteredCommand registered_metrics{105, add_metrics_command};

}  // namespace
}  // namespace dressform
