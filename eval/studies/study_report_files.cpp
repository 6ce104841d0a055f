#include <fmt/format.h>

#include <cmath>

#include "eval/report/csv.h"
#include "eval/studies/study_report.h"
#include "scenes/hash.h"

namespace dressform {
namespace {

std::string markdown_cell(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '|' || letter == '<') result += '\\';
    result += letter == '\n' ? ' ' : letter;
  }
  return result;
}

std::string markdown_table(const ReportTable& table) {
  std::string text = "|", rule = "\n|";
  for (const auto& column : table.columns) text += " " + markdown_cell(column) + " |", rule += "---|";
  text += rule + "\n";
  for (const auto& row : table.rows) {
    text += "|";
    for (const auto& cell : row) {
      const bool strong = cell.mark == "good" || cell.mark == "bad";
      text += strong ? " **" + markdown_cell(cell.text) + "** |" : " " + markdown_cell(cell.text) + " |";
    }
    text += "\n";
  }
  return text;
}

std::string csv_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "nan"; }
std::string csv_number(const std::optional<double>& value) { return value ? csv_number(*value) : ""; }
std::string interval_csv(const std::optional<Interval>& interval) {
  return interval ? csv_number(interval->low) + "," + csv_number(interval->high) : ",";
}

std::string signature_hash(const Signature& signature) {
  std::string text;
  for (const auto& [name, value] : comparable(signature)) text += name + " " + value + "\n";
  return hash_hex(text).substr(0, 12);
}

const char* state_word(Outcome::State state) {
  return state == Outcome::State::measured ? "ok" : state == Outcome::State::failed ? "failed" : "absent";
}

}  // namespace

std::string report_markdown(const StudyReport& report) {
  std::string text = "# " + report.title + "\n\n**" + markdown_cell(report.headline) + "**\n";
  for (const auto& section : report.sections) {
    text += "\n## " + markdown_cell(section.heading) + "\n";
    for (const auto& words : section.paragraphs) text += "\n" + markdown_cell(words) + "\n";
    if (section.table) text += "\n" + markdown_table(*section.table);
  }
  return text;
}

std::string report_html(const StudyReport& report) {
  HtmlPage page(report.title);
  page.verdict(report.headline, true);
  for (const auto& section : report.sections) {
    page.heading(section.heading, section.id);
    for (const auto& words : section.paragraphs) page.paragraph(words);
    if (!section.drawing.empty()) page.drawing(section.heading, section.drawing_caption, section.drawing);
    if (section.table) page.table(section.table->columns, section.table->rows);
  }
  return page.text();
}

std::string results_csv(const StudyResults& results) {
  const Study& study = results.plan.study;
  const std::string signature = signature_hash(results.signature);
  std::string text = "variant,scene,seed,scale,status,metric,role,unit,value,cell,signature\n";
  for (const auto& each : results.planned) {
    const auto found = results.cells.find(each.id);
    if (found == results.cells.end()) continue;
    const CellResult& cell = found->second;
    for (const auto& metric : study.metrics) {
      const Outcome outcome = cell.failed ? Outcome{Outcome::State::failed, 0} : outcome_of(metric, cell.scores);
      text += fmt::format(
          "{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(study.variants[each.variant].name),
          csv_field(results.plan.scenes[each.scene].name), each.seed, cell.scale, state_word(outcome.state),
          csv_field(metric.text), metric.primary ? "primary" : "secondary", metric.metric->unit,
          outcome.state == Outcome::State::measured ? csv_number(outcome.value) : "nan", each.id, signature);
    }
  }
  return text;
}

std::string comparisons_csv(const StudyResults& results, const std::vector<VariantSummary>& summaries) {
  const Study& study = results.plan.study;
  const std::string signature = signature_hash(results.signature);
  std::string text =
      "variant,baseline,metric,role,unit,margin,pairs,baseline_mean,variant_mean,difference,low,high,p,p_holm,"
      "p_equivalent,smallest_effect,verdict,variant_ok,variant_scenes,baseline_ok,baseline_scenes,better,worse,equal,"
      "p_with_failures,signature\n";
  for (const auto& summary : summaries) {
    const std::string& name = study.variants[summary.variant].name;
    if (name == study.baseline) continue;
    for (std::size_t m = 0; m < study.metrics.size(); ++m) {
      const StudyMetric& metric = study.metrics[m];
      const Comparison& c = summary.comparisons[m];
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},", csv_field(name), csv_field(study.baseline),
                          csv_field(metric.text), metric.primary ? "primary" : "secondary", metric.metric->unit,
                          metric.margin, c.pairs(), csv_number(c.baseline_mean), csv_number(c.variant_mean),
                          csv_number(c.effect));
      text +=
          fmt::format("{},{},{},{},{},{},", interval_csv(c.interval), csv_number(c.p), csv_number(c.p_holm),
                      csv_number(c.p_equivalent), csv_number(c.detectable), metric.primary ? to_text(c.verdict) : "");
      text += fmt::format("{},{},{},{},{},{},{},{},{}\n", c.variant_success.successes, c.variant_success.trials,
                          c.baseline_success.successes, c.baseline_success.trials, c.with_failures.better,
                          c.with_failures.worse, c.with_failures.equal, csv_number(c.with_failures.p), signature);
    }
  }
  return text;
}

}  // namespace dressform
