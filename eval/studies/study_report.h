#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "eval/report/html.h"
#include "eval/studies/study_results.h"

namespace dressform {

// A report as both its forms hold it. Markdown leaves the drawings out.
struct ReportTable {
  std::vector<std::string> columns;
  std::vector<std::vector<HtmlPage::Cell>> rows;
};
struct ReportSection {
  std::string heading, id;
  std::vector<std::string> paragraphs;
  std::optional<ReportTable> table;
  std::string drawing, drawing_caption;  // SVG
};
struct StudyReport {
  std::string title, headline;
  std::vector<ReportSection> sections;
};

// First the verdicts, on one screen: which variant is better, by how much, how sure, at what cost. Then each metric
// with its intervals, p, failures and smallest effect, the targets by stratum, the scenes one by one, and what failed.
// The same cells give the same report, but for the seconds; `seconds` false leaves them out. `summaries`: what
// compare_variants gives for the results.
StudyReport study_report(const StudyResults& results, const std::vector<VariantSummary>& summaries,
                         bool seconds = true);
std::string report_markdown(const StudyReport& report);
std::string report_html(const StudyReport& report);  // one file, nothing fetched, no scripts

// variant,scene,seed,scale,status,metric,role,unit,value,cell,signature: one line a cell and metric.
std::string results_csv(const StudyResults& results);
// One line a variant and metric: effect, interval, p, verdict, failures.
std::string comparisons_csv(const StudyResults& results, const std::vector<VariantSummary>& summaries);

struct WrittenReport {
  std::string headline;
  std::vector<std::filesystem::path> files;
};
// report.md, report.html, results.csv and comparisons.csv into the study's folder.
WrittenReport write_study_report(const std::filesystem::path& folder, bool seconds = true);

}  // namespace dressform
