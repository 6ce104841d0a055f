#include "eval/studies/study_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "eval/report/csv.h"
#include "eval/report/html.h"

namespace dressform {
namespace {

using Mark = StudyTable::Cell::Mark;

// Whether the comparison at `better_place` is told from the one at `next`, of two that follow one another in rank.
bool told_apart(const std::vector<const Comparison*>& comparisons, std::size_t better_place, std::size_t next) {
  if (next == 0) return comparisons[better_place]->verdict == Verdict::better;
  if (better_place == 0) return comparisons[next]->verdict == Verdict::worse;
  const auto& a = comparisons[better_place]->interval;
  const auto& b = comparisons[next]->interval;
  return a && b && (a->high < b->low || b->high < a->low);
}

// A number without its unit: three figures behind the point where it is small, fewer where it is large.
std::string bare_number(double value) {
  if (!std::isfinite(value)) return "-";
  return fmt::format("{:.{}f}", value, std::abs(value) < 2 ? 3 : std::abs(value) < 100 ? 2 : 1);
}

std::string latex_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (std::string("&%$#_{}").find(c) != std::string::npos) result += '\\';
    if (c == '<')
      result += "\\textless{}";
    else if (c == '>')
      result += "\\textgreater{}";
    else
      result += c;
  }
  return result;
}

std::string with_failures(const StudyTable::Cell& cell) {
  return cell.failed ? fmt::format("{} ({} failed)", cell.text, cell.failed) : cell.text;
}

}  // namespace

std::vector<Mark> supported_marks(const std::vector<const Comparison*>& comparisons, Better better) {
  std::vector<Mark> marks(comparisons.size(), Mark::none);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < comparisons.size(); ++i)
    if (i == 0 || std::isfinite(comparisons[i]->effect)) order.push_back(i);
  // By the paired difference, which the baseline has none of; the means are of other scenes where some failed.
  const auto difference = [&](std::size_t i) { return i == 0 ? 0 : comparisons[i]->effect; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return better == Better::higher ? difference(a) > difference(b) : difference(a) < difference(b);
  });
  if (order.size() < 2 || !told_apart(comparisons, order[0], order[1])) return marks;
  marks[order[0]] = Mark::best;
  if (order.size() > 2 && told_apart(comparisons, order[1], order[2])) marks[order[1]] = Mark::second;
  return marks;
}

StudyTable study_table(const StudyResults& results, const std::vector<VariantSummary>& summaries) {
  const Study& study = results.plan.study;
  StudyTable table;
  table.caption =
      fmt::format("{}: means over {} scenes, scale {:g}", study.name, results.plan.scenes.size(), study.scale);
  for (const auto& summary : summaries) table.variants.push_back(study.variants[summary.variant].name);
  table.rows.resize(summaries.size());
  for (std::size_t m = 0; m < study.metrics.size(); ++m) {
    const StudyMetric& metric = study.metrics[m];
    table.heads.push_back(metric.metric->unit == "1" ? metric.text : metric.text + " [" + metric.metric->unit + "]");
    std::vector<const Comparison*> comparisons;
    for (const auto& summary : summaries) comparisons.push_back(&summary.comparisons[m]);
    std::vector<Mark> marks(summaries.size(), Mark::none);
    if (metric.primary) marks = supported_marks(comparisons, metric.metric->better);
    for (std::size_t v = 0; v < summaries.size(); ++v) {
      const Comparison& comparison = *comparisons[v];
      const SuccessRate& rate = comparison.variant_success;
      table.rows[v].push_back({bare_number(v == 0 ? comparison.baseline_mean : comparison.variant_mean), marks[v],
                               rate.trials - rate.successes});
    }
  }
  return table;
}

std::string study_table_markdown(const StudyTable& table) {
  const auto escaped = [](const std::string& text) {
    std::string result;
    for (const char c : text) result += c == '|' ? "\\|" : c == '<' ? "\\<" : std::string(1, c);
    return result;
  };
  std::string text = table.caption + "\n\n| variant |", rule = "\n|---|";
  for (const auto& head : table.heads) text += " " + escaped(head) + " |", rule += "---:|";
  text += rule + "\n";
  for (std::size_t v = 0; v < table.variants.size(); ++v) {
    text += "| " + escaped(table.variants[v]) + " |";
    for (const auto& cell : table.rows[v]) {
      const std::string value = with_failures(cell);
      text += cell.mark == Mark::best     ? " **" + value + "** |"
              : cell.mark == Mark::second ? " <u>" + value + "</u> |"
                                          : " " + value + " |";
    }
    text += "\n";
  }
  return text + "\nBold: best, underlined: second, where the study tells them from the next.\n";
}

std::string study_table_csv(const StudyTable& table) {
  std::string text = "variant,metric,value,mark,failed\n";
  for (std::size_t v = 0; v < table.variants.size(); ++v)
    for (std::size_t m = 0; m < table.heads.size(); ++m) {
      const auto& cell = table.rows[v][m];
      const char* mark = cell.mark == Mark::best ? "best" : cell.mark == Mark::second ? "second" : "";
      text += fmt::format("{},{},{},{},{}\n", csv_field(table.variants[v]), csv_field(table.heads[m]), cell.text, mark,
                          cell.failed);
    }
  return text;
}

std::string study_table_latex(const StudyTable& table) {
  std::string text = "% \\usepackage{booktabs,siunitx} with \\sisetup{detect-all}\n\\begin{table}\n\\centering\n";
  text += "\\caption{" + latex_text(table.caption) + "}\n\\begin{tabular}{l" + std::string(table.heads.size(), 'S') +
          "}\n\\toprule\n{variant}";
  for (const auto& head : table.heads) text += " & {" + latex_text(head) + "}";
  text += " \\\\\n\\midrule\n";
  for (std::size_t v = 0; v < table.variants.size(); ++v) {
    text += latex_text(table.variants[v]);
    for (const auto& cell : table.rows[v]) {
      const std::string failed = cell.failed ? fmt::format("\\,({} failed)", cell.failed) : "";
      if (cell.mark == Mark::second || cell.text == "-" || cell.failed) {  // not a bare number: out of siunitx's hands
        const char* around = cell.mark == Mark::best ? "\\textbf" : cell.mark == Mark::second ? "\\underline" : "";
        text += fmt::format(" & {{{}{{{}}}{}}}", around, cell.text, failed);
      } else {
        text += cell.mark == Mark::best ? " & \\bfseries " + cell.text : " & " + cell.text;
      }
    }
    text += " \\\\\n";
  }
  return text + "\\bottomrule\n\\end{tabular}\n\\end{table}\n";
}

std::string study_table_html(const StudyTable& table) {
  HtmlPage page(table.caption);
  std::vector<std::string> columns{"variant"};
  columns.insert(columns.end(), table.heads.begin(), table.heads.end());
  std::vector<std::vector<HtmlPage::Cell>> rows;
  for (std::size_t v = 0; v < table.variants.size(); ++v) {
    rows.push_back({{table.variants[v], ""}});
    for (const auto& cell : table.rows[v])
      rows.back().push_back({with_failures(cell), cell.mark == Mark::best     ? "best"
                                                  : cell.mark == Mark::second ? "second"
                                                                              : ""});
  }
  page.table(columns, rows);
  page.paragraph("Bold: best, underlined: second, where the study tells them from the next.");
  return page.text();
}

}  // namespace dressform
