#include "eval/report/metric_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "eval/report/csv.h"
#include "scenes/error.h"

namespace dressform {
namespace {

const char* word_of(Better better) {
  switch (better) {
    case Better::lower:
      return "lower";
    case Better::higher:
      return "higher";
    case Better::near_zero:
      return "near 0";
    case Better::neither:
      break;
  }
  return "";
}

std::string target_with_scale(const Metric& metric) {
  if (!metric.target) return {};
  return fmt::format("{}{}, from scale {:g}", metric.only.empty() ? "" : metric.only + " ", metric.target_text(),
                     metric.from_scale);
}

std::string nuisance_text(const Metric& metric) {
  const Nuisance nuisance = metric.nuisance();
  std::string text = nuisance.name;
  if (nuisance.absolute > 0) text += fmt::format(" {:g}", nuisance.absolute);
  if (nuisance.relative > 0) text += fmt::format(" + {:g} %", 100 * nuisance.relative);
  return text;
}

std::string definition_with_source(const Metric& metric) {
  return metric.definition + (metric.paper.empty() ? "" : " (" + metric.paper + ")");
}

// A line of a Markdown table; a bar would end the cell.
std::string table_line(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const auto& cell : cells) {
    line += cell.empty() ? "" : " ";
    for (const char letter : cell) line += letter == '|' ? std::string("\\|") : std::string(1, letter);
    line += " |";
  }
  return line + "\n";
}

// The text of the table that a line of a document begins; empty when it begins none.
std::string table_of_marker(const std::string& line) {
  if (line == "<!-- metrics -->") return metrics_markdown(all_metrics());
  if (line == "<!-- metrics: legend -->") return legend_markdown(all_metrics());
  return {};
}

}  // namespace

std::string metrics_markdown(const std::vector<const Metric*>& metrics) {
  std::string text =
      "| stage | metric | unit | better | target | nuisance | definition |\n|---|---|---|---|---|---|---|\n";
  std::string stage;
  for (const Metric* metric : metrics) {
    text += table_line({metric->stage == stage ? "" : metric->stage,
                        fmt::format("`{}@{}`", metric->name, metric->version), metric->unit, word_of(metric->better),
                        target_with_scale(*metric), nuisance_text(*metric), definition_with_source(*metric)});
    stage = metric->stage;
  }
  return text;
}

std::string legend_markdown(const std::vector<const Metric*>& metrics) {
  std::string text = "| line | metric | target | from scale | definition |\n|---|---|---|---|---|\n";
  for (const Metric* metric : metrics)
    if (!metric->headline.empty())
      text +=
          table_line({"`" + metric->headline + "`",
                      fmt::format("{} `{}@{}`", metric->stage, metric->name, metric->version), metric->target_text(),
                      metric->target ? fmt::format("{:g}", metric->from_scale) : "", definition_with_source(*metric)});
  return text;
}

std::string metrics_csv(const std::vector<const Metric*>& metrics) {
  std::string text =
      "stage,metric,version,unit,better,target,target_only,from_scale,headline,nuisance,nuisance_absolute,"
      "nuisance_relative,definition,paper\n";
  for (const Metric* metric : metrics) {
    const Nuisance nuisance = metric->nuisance();
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{:g},{:g},{},{}\n", metric->stage, metric->name, metric->version, metric->unit,
        word_of(metric->better), metric->target ? fmt::format("{:g}", *metric->target) : "", metric->only,
        metric->target ? fmt::format("{:g}", metric->from_scale) : "", csv_field(metric->headline), nuisance.name,
        nuisance.absolute, nuisance.relative, csv_field(metric->definition), csv_field(metric->paper));
  }
  return text;
}

std::string metrics_json(const std::vector<const Metric*>& metrics) {
  auto rows = nlohmann::ordered_json::array();
  for (const Metric* metric : metrics) {
    const Nuisance nuisance = metric->nuisance();
    nlohmann::ordered_json row = {{"stage", metric->stage},
                                  {"metric", metric->name},
                                  {"version", metric->version},
                                  {"unit", metric->unit},
                                  {"better", word_of(metric->better)},
                                  {"definition", metric->definition},
                                  {"paper", metric->paper},
                                  {"headline", metric->headline}};
    row["nuisance"] = {{"class", nuisance.name}, {"absolute", nuisance.absolute}, {"relative", nuisance.relative}};
    if (metric->target)
      row["target"] = {{"bound", *metric->target}, {"from_scale", metric->from_scale}, {"only", metric->only}};
    rows.push_back(row);
  }
  return nlohmann::ordered_json{{"format", "dressform-metrics"}, {"version", 1}, {"metrics", rows}}.dump(1) + "\n";
}

std::vector<const Metric*> metrics_of(const std::string& stage) {
  std::vector<const Metric*> chosen;
  std::string known;
  for (const Metric* metric : all_metrics()) {
    if (stage.empty() || metric->stage == stage) chosen.push_back(metric);
    if (known.find(metric->stage) == std::string::npos) known += (known.empty() ? "" : ", ") + metric->stage;
  }
  if (chosen.empty()) throw InputError("stage " + stage, "has no metrics; expected one of " + known);
  return chosen;
}

std::string with_metric_tables(const std::string& document, const std::string& where) {
  std::string result;
  bool found = false;
  for (std::size_t at = 0; at < document.size();) {
    const std::size_t end = std::min(document.find('\n', at), document.size() - 1) + 1;
    const std::string line = document.substr(at, end - at);
    result += line;
    at = end;
    const std::string table = table_of_marker(line.substr(0, line.find('\n')));
    if (table.empty()) continue;
    found = true;
    at = document.find("<!-- /metrics -->", at);
    if (at == std::string::npos) throw InputError(where, "a table of metrics does not end; expected <!-- /metrics -->");
    result += "\n" + table + "\n";
  }
  if (!found) throw InputError(where, "has no table of metrics; expected a line <!-- metrics -->");
  return result;
}

}  // namespace dressform
