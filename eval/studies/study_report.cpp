#include "eval/studies/study_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "eval/studies/forest.h"
#include "scenes/file_bytes.h"

namespace dressform {
namespace {

using Cell = HtmlPage::Cell;

std::string mark_of(Verdict verdict) {
  return verdict == Verdict::better         ? "good"
         : verdict == Verdict::worse        ? "bad"
         : verdict == Verdict::inconclusive ? "quiet"
                                            : "";
}

std::string p_text(const std::optional<double>& p) {
  if (!p) return "-";
  return *p < 0.0005 ? "< 0.001" : fmt::format("{:.3f}", *p);
}

std::string interval_text(const StudyMetric& metric, const std::optional<Interval>& interval) {
  if (!interval) return "-";
  return fmt::format("{} to {}", difference_text(metric, interval->low), difference_text(metric, interval->high));
}

// "8 of 12 (39 to 86 %)".
std::string rate_text(const SuccessRate& rate) {
  if (rate.trials == 0) return "-";
  return fmt::format("{} of {} ({:.0f} to {:.0f} %)", rate.successes, rate.trials, 100 * rate.interval.low,
                     100 * rate.interval.high);
}

std::string value_text(const StudyMetric& metric, double value, const char* without = "-") {
  return std::isfinite(value) ? number_text(value, metric.metric->unit) : without;
}

class ReportMaker {
 public:
  ReportMaker(const StudyResults& results, const std::vector<VariantSummary>& summaries, bool seconds)
      : results_(results), study_(results.plan.study), seconds_(seconds), summaries_(summaries) {}

  StudyReport make() const {
    StudyReport report{study_.name, headline(), {}};
    report.sections.push_back(verdicts());
    for (std::size_t m = 0; m < study_.metrics.size(); ++m) report.sections.push_back(metric_section(m));
    report.sections.push_back(targets());
    for (std::size_t m = 0; m < study_.metrics.size(); ++m)
      if (study_.metrics[m].primary) report.sections.push_back(scenes(m));
    report.sections.push_back(failures());
    report.sections.push_back(method());
    return report;
  }

 private:
  const std::string& name_of(const VariantSummary& summary) const { return study_.variants[summary.variant].name; }

  // "surface <slot>/f_5mm@1 against default: better a, b; worse c".
  std::string headline() const {
    std::string text;
    for (const Verdict verdict : {Verdict::better, Verdict::worse, Verdict::equivalent, Verdict::inconclusive}) {
      std::string names;
      for (std::size_t i = 1; i < summaries_.size(); ++i)
        if (summaries_[i].comparisons.front().verdict == verdict)
          names += (names.empty() ? " " : ", ") + name_of(summaries_[i]);
      if (!names.empty()) text += (text.empty() ? "" : "; ") + to_text(verdict) + names;
    }
    return fmt::format("{} against {}: {}", study_.metrics.front().text, study_.baseline, text);
  }

  std::string extent() const {
    return fmt::format("{} variants on {} scenes with {} seed{} each; {} of {} cells are there, scale {:g}. {}",
                       study_.variants.size(), results_.plan.scenes.size(), study_.seeds.size(),
                       study_.seeds.size() == 1 ? "" : "s", present(), results_.planned.size(), study_.scale,
                       signature_text());
  }

  std::size_t present() const {
    return static_cast<std::size_t>(std::count_if(results_.planned.begin(), results_.planned.end(),
                                                  [&](const auto& each) { return results_.cells.count(each.id) > 0; }));
  }

  std::string signature_text() const {
    std::string text = "Signature:";
    for (const auto& [name, value] : results_.signature) text += " " + name + " " + value + ",";
    text.back() = '.';
    return text;
  }

  std::vector<std::string> verdict_columns() const {
    std::vector<std::string> columns{"variant"};
    for (const auto& metric : study_.metrics)
      if (metric.primary) {
        columns.push_back(metric.text);
        columns.push_back("difference (95 % interval)");
        columns.push_back("p (Holm)");
      }
    columns.push_back("cells failed");
    if (seconds_) columns.push_back("seconds"), columns.push_back("of baseline");
    return columns;
  }

  void add_verdict(const StudyMetric& metric, const Comparison& comparison, bool baseline,
                   std::vector<Cell>& row) const {
    if (baseline) {
      row.push_back({value_text(metric, comparison.baseline_mean), ""});
      row.push_back({"baseline", "quiet"});
      row.push_back({"", ""});
      return;
    }
    row.push_back({to_text(comparison.verdict), mark_of(comparison.verdict)});
    row.push_back(
        {fmt::format("{} ({})", difference_text(metric, comparison.effect), interval_text(metric, comparison.interval)),
         ""});
    row.push_back({p_text(comparison.p_holm), ""});
  }

  ReportSection verdicts() const {
    ReportTable table{verdict_columns(), {}};
    for (std::size_t i = 0; i < summaries_.size(); ++i) {
      const VariantSummary& summary = summaries_[i];
      std::vector<Cell> row{{name_of(summary), ""}};
      for (std::size_t m = 0; m < study_.metrics.size(); ++m)
        if (study_.metrics[m].primary) add_verdict(study_.metrics[m], summary.comparisons[m], i == 0, row);
      row.push_back({fmt::format("{} of {}", summary.failed, summary.cells), summary.failed ? "bad" : ""});
      if (seconds_) {
        const auto& base = summaries_.front().seconds;
        row.push_back({summary.seconds ? fmt::format("{:.1f}", *summary.seconds) : "-", ""});
        row.push_back(
            {summary.seconds && base && *base > 0 ? fmt::format("{:.2f} x", *summary.seconds / *base) : "-", ""});
      }
      table.rows.push_back(row);
    }
    std::vector<std::string> words;
    if (!study_.description.empty()) words.push_back(study_.description);
    words.push_back(extent());
    if (const int n = summaries_.back().comparisons.front().pairs(); n < kFewestScenes)
      words.push_back(fmt::format("Fewer than {} scenes: no p and no verdict; see the dots.", kFewestScenes));
    return {"Verdicts", "verdicts", words, table, "", ""};
  }

  ReportSection metric_section(std::size_t m) const {
    const StudyMetric& metric = study_.metrics[m];
    ReportTable table{{"variant", "verdict", "baseline", "variant", "difference", "95 % interval", "p", "p (Holm)",
                       "p (equivalent)", "smallest effect seen", "pairs", "gave a number", "failures as worst"},
                      {}};
    for (std::size_t i = 1; i < summaries_.size(); ++i) table.rows.push_back(metric_row(metric, summaries_[i], m));
    std::vector<std::string> words{metric.metric->definition};
    words.push_back(metric.primary
                        ? "Primary; a difference within +-" + number_text(metric.margin, metric.metric->unit) +
                              " was declared not to matter."
                        : "Secondary: interval and p are for looking, nothing is concluded from them.");
    return {(metric.primary ? "Primary: " : "Secondary: ") + metric.text,
            fmt::format("metric{}", m),
            words,
            table,
            forest_svg(results_, summaries_, m),
            "A dot a scene, seeds averaged; the mean with its 95 % interval; the margin shaded."};
  }

  std::vector<Cell> metric_row(const StudyMetric& metric, const VariantSummary& summary, std::size_t m) const {
    const Comparison& c = summary.comparisons[m];
    const auto& worst = c.with_failures;
    return {
        {name_of(summary), ""},
        {metric.primary ? to_text(c.verdict) : "", metric.primary ? mark_of(c.verdict) : ""},
        {value_text(metric, c.baseline_mean), ""},
        {value_text(metric, c.variant_mean), ""},
        {difference_text(metric, c.effect), ""},
        {interval_text(metric, c.interval), ""},
        {p_text(c.p), ""},
        {p_text(c.p_holm), ""},
        {p_text(c.p_equivalent), ""},
        {value_text(metric, c.detectable, "none"), ""},
        {std::to_string(c.pairs()), ""},
        {rate_text(c.variant_success) + "; baseline " + rate_text(c.baseline_success), ""},
        {fmt::format("better {}, worse {}, equal {}; p {}", worst.better, worst.worse, worst.equal, p_text(worst.p)),
         ""}};
  }

  void add_targets(const VariantSummary& summary, const std::string& stratum, ReportTable& table) const {
    const TargetsMet count = count_targets(results_, summary.variant, stratum);
    if (count.scenes == 0) return;
    const SuccessRate rate{count.all_met, count.scenes, wilson_interval(count.all_met, count.scenes)};
    table.rows.push_back({{name_of(summary), ""},
                          {stratum.empty() ? "all" : stratum, ""},
                          {rate_text(rate), ""},
                          {fmt::format("{} of {}", count.met, count.asked), ""}});
  }

  ReportSection targets() const {
    ReportTable table{{"variant", "scenes", "all targets met", "targets met"}, {}};
    for (const auto& summary : summaries_) add_targets(summary, "", table);
    for (const auto& stratum : known_strata()) add_targets(summaries_.front(), stratum.name, table);
    return {"Targets",
            "targets",
            {"Targets that are meant to hold at this scale (dressform metrics); by stratum for the baseline."},
            table,
            "",
            ""};
  }

  static Cell outcome_cell(const StudyMetric& metric, const Outcome& outcome) {
    if (outcome.state == Outcome::State::failed) return {"failed", "bad"};
    if (outcome.state == Outcome::State::absent) return {"-", "quiet"};
    return {value_text(metric, outcome.value), ""};
  }

  ReportSection scenes(std::size_t m) const {
    const StudyMetric& metric = study_.metrics[m];
    ReportTable table{{"scene", "strata"}, {}};
    for (const auto& summary : summaries_) table.columns.push_back(name_of(summary));
    for (std::size_t s = 0; s < results_.plan.scenes.size(); ++s) {
      const auto& scene = results_.plan.scenes[s];
      std::vector<Cell> row{{scene.name, ""}, {fmt::format("{}", fmt::join(scene.strata, ", ")), "quiet"}};
      for (const auto& summary : summaries_)
        row.push_back(outcome_cell(metric, results_.outcome(summary.variant, s, metric)));
      table.rows.push_back(row);
    }
    return {"Scenes: " + metric.text, fmt::format("scenes{}", m), {}, table, "", ""};
  }

  ReportSection failures() const {
    ReportTable table{{"variant", "scene", "seed", "what", "cell"}, {}};
    for (const auto& each : results_.planned) {
      const auto cell = results_.cells.find(each.id);
      if (cell == results_.cells.end()) continue;
      std::vector<std::string> what = cell->second.problems;
      if (cell->second.failed) what.push_back(cell->second.reason);
      for (const auto& words : what)
        table.rows.push_back({{study_.variants[each.variant].name, ""},
                              {results_.plan.scenes[each.scene].name, ""},
                              {std::to_string(each.seed), ""},
                              {words, cell->second.failed ? "bad" : ""},
                              {each.id, "quiet"}});
    }
    const std::string none =
        table.rows.empty() ? "Nothing failed." : "Stages that did not manage, and cells that ended without scores.";
    return {"Failures", "failures", {none}, table.rows.empty() ? std::optional<ReportTable>() : table, "", ""};
  }

  ReportSection method() const {
    return {
        "How it is told",
        "method",
        {"The unit is the scene: seeds are averaged inside it, and the variants are compared scene by scene. "
         "Interval: bootstrap-t of the mean difference. p: sign flips, exact up to 20 scenes; Holm over the primary "
         "metrics of one variant. Equivalent: two one-sided t tests within the margin. Smallest effect seen: with "
         "80 % power by the t test, from the spread of these differences.",
         "Failures are counted three ways: how many scenes gave a number (Wilson interval), the comparison of the "
         "complete pairs, and all scenes with a failure as the worst rank.",
         "The verdicts of several variants are not corrected for how many were tried: confirm a winner of many on "
         "scenes of other seeds."},
        {},
        "",
        ""};
  }

  const StudyResults& results_;
  const Study& study_;
  bool seconds_;
  const std::vector<VariantSummary>& summaries_;
};

}  // namespace

StudyReport study_report(const StudyResults& results, const std::vector<VariantSummary>& summaries, bool seconds) {
  return ReportMaker(results, summaries, seconds).make();
}

WrittenReport write_study_report(const std::filesystem::path& folder, bool seconds) {
  const StudyResults results = read_results(folder);
  const std::vector<VariantSummary> summaries = compare_variants(results);
  const StudyReport report = study_report(results, summaries, seconds);
  const std::vector<std::pair<const char*, std::string>> files{
      {"report.md", report_markdown(report)},
      {"report.html", report_html(report)},
      {"results.csv", results_csv(results)},
      {"comparisons.csv", comparisons_csv(results, summaries)}};
  WrittenReport written{report.headline, {}};
  for (const auto& [name, bytes] : files) {
    write_file_atomically(folder / name, bytes);
    written.files.push_back(folder / name);
  }
  return written;
}

}  // namespace dressform
