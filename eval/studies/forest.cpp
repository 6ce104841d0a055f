#include "eval/studies/forest.h"

namespace dressform {

RowChart forest_chart(const StudyResults& results, const std::vector<VariantSummary>& summaries, std::size_t metric) {
  const StudyMetric& asked = results.plan.study.metrics[metric];
  RowChart chart;
  const bool bare = asked.metric->unit == "1";
  chart.title = asked.text;
  chart.axis = "difference from the baseline" + (bare ? "" : ", " + asked.metric->unit);
  const bool up = asked.metric->better == Better::higher;
  chart.left_word = up ? "worse" : "better";
  chart.right_word = up ? "better" : "worse";
  chart.line = 0;
  chart.margin = asked.margin;
  for (std::size_t i = 1; i < summaries.size(); ++i) {  // the baseline comes first
    const Comparison& comparison = summaries[i].comparisons[metric];
    RowChart::Row row;
    row.name = results.plan.study.variants[summaries[i].variant].name;
    for (const auto& difference : comparison.differences) row.dots.push_back({difference.value, 1});
    if (comparison.pairs() > 0) row.mean = comparison.effect;
    if (comparison.interval) row.interval = RowChart::Span{comparison.interval->low, comparison.interval->high};
    if (asked.primary) row.note = to_text(comparison.verdict);
    chart.rows.push_back(row);
  }
  return chart;
}

std::string forest_svg(const StudyResults& results, const std::vector<VariantSummary>& summaries, std::size_t metric) {
  return sheet_svg(row_chart_sheet(forest_chart(results, summaries, metric)));
}

}  // namespace dressform
