#include "eval/figures/study_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "eval/studies/forest.h"

namespace dressform {
namespace {

using State = Outcome::State;

// A metric's name as a file's: letters and figures, everything else one dash.
std::string file_part(const std::string& text) {
  std::string part;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)))
      part += c;
    else if (!part.empty() && part.back() != '-')
      part += '-';
  while (!part.empty() && part.back() == '-') part.pop_back();
  return part;
}

std::string axis_label(const StudyMetric& metric) {
  return metric.metric->unit == "1" ? metric.text : metric.text + " [" + metric.metric->unit + "]";
}

class StudyPlotter {
 public:
  StudyPlotter(const StudyResults& results, const FigureStyle& style)
      : results_(results), study_(results.plan.study), style_(style), summaries_(compare_variants(results)) {}

  StudyFigure forest(std::size_t m) const {
    return {"forest_" + file_part(study_.metrics[m].text), "paired differences from " + study_.baseline,
            row_chart_sheet(forest_chart(results_, summaries_, m), style_), ""};
  }

  StudyFigure scenes(std::size_t m) const {
    const StudyMetric& metric = study_.metrics[m];
    RowChart chart;
    chart.title = metric.text + ", scene by scene", chart.axis = axis_label(metric);
    for (std::size_t v = 0; v < study_.variants.size(); ++v)
      chart.legend.push_back({study_.variants[v].name, static_cast<int>(v)});
    for (std::size_t s = 0; s < results_.plan.scenes.size(); ++s) {
      RowChart::Row row;
      row.name = results_.plan.scenes[s].name;
      int failed = 0;
      for (std::size_t v = 0; v < study_.variants.size(); ++v) {
        const Outcome outcome = results_.outcome(v, s, metric);
        if (outcome.state == State::measured) row.dots.push_back({outcome.value, static_cast<int>(v)});
        failed += outcome.state == State::failed;
      }
      if (failed) row.note = fmt::format("{} failed", failed);
      chart.rows.push_back(row);
    }
    if (study_.variants.size() > kMostColors) chart.legend.clear();  // colours repeat: they tell no one apart
    return {"scenes_" + file_part(metric.text), "values by scene", row_chart_sheet(chart, style_), ""};
  }

  StudyFigure success(std::size_t m) const {
    const StudyMetric& metric = study_.metrics[m];
    StudyFigure figure{"success_" + file_part(metric.text), "part of the scenes within a bound", {}, ""};
    Chart chart = empty_chart(figure.stem, metric.text + ": scenes within", "", {axis_label(metric), 0, 1},
                              {"part of the scenes", 0, 1});
    double most = 0;
    for (std::size_t v = 0; v < study_.variants.size(); ++v) {
      std::vector<double> values;
      int scenes = 0;
      for (std::size_t s = 0; s < results_.plan.scenes.size(); ++s) {
        const Outcome outcome = results_.outcome(v, s, metric);
        if (outcome.state == State::measured) values.push_back(outcome.value), most = std::max(most, outcome.value);
        scenes += outcome.state != State::absent;
      }
      if (scenes > 0)
        chart.curves.push_back(
            success_curve(study_.variants[v].name, static_cast<int>(v), values, scenes, metric.metric->better));
    }
    if (chart.curves.empty() || !(most > 0)) {
      figure.reason = "no scene has a value";
      return figure;
    }
    chart.x.maximum = 1.05 * most;
    for (auto& curve : chart.curves) {  // flat to the chart's edges
      curve.points.insert(curve.points.begin(), {0, curve.points.front().y()});
      curve.points.push_back({chart.x.maximum, curve.points.back().y()});
    }
    figure.sheet = chart_sheet(chart, style_);
    return figure;
  }

  StudyFigure cost(std::size_t m) const {
    const StudyMetric& metric = study_.metrics[m];
    StudyFigure figure{"cost_" + file_part(metric.text), "quality against time", {}, ""};
    Chart chart = empty_chart(figure.stem, metric.text + " against time", "", {"seconds of the pipeline", 0, 1});
    double most = 0;
    for (const auto& summary : summaries_) {
      const double value = summary.comparisons[m].variant_mean;
      if (!summary.seconds || !std::isfinite(value)) continue;
      most = std::max(most, *summary.seconds);
      chart.curves.push_back({study_.variants[summary.variant].name,
                              Curve::dots,
                              static_cast<int>(summary.variant),
                              {{*summary.seconds, value}}});
    }
    if (chart.curves.empty()) {
      figure.reason = "no cell has a record of its seconds";
      return figure;
    }
    chart.x.maximum = 1.1 * most;
    chart.y = axis_around(chart, axis_label(metric));
    figure.sheet = chart_sheet(chart, style_);
    return figure;
  }

 private:
  static constexpr std::size_t kMostColors = 7;
  const StudyResults& results_;
  const Study& study_;
  const FigureStyle& style_;
  std::vector<VariantSummary> summaries_;
};

}  // namespace

Curve success_curve(const std::string& name, int color, std::vector<double> values, int scenes, Better better) {
  Curve curve{name, Curve::line, color, {}};
  std::sort(values.begin(), values.end());
  const double all = scenes;
  const bool up = better == Better::higher;  // then the part falls as the bound rises
  double part = up ? static_cast<double>(values.size()) / all : 0;
  if (values.empty()) curve.points.push_back({0, 0});
  for (const double value : values) {
    curve.points.push_back({value, part});
    part += (up ? -1 : 1) / all;
    curve.points.push_back({value, part});
  }
  return curve;
}

std::vector<StudyFigure> study_figures(const StudyResults& results, const FigureStyle& style) {
  const StudyPlotter plotter(results, style);
  std::vector<StudyFigure> figures;
  const auto& metrics = results.plan.study.metrics;
  for (std::size_t m = 0; m < metrics.size(); ++m) {
    const std::string& unit = metrics[m].metric->unit;
    if (metrics[m].primary) {
      figures.push_back(plotter.forest(m));
      figures.push_back(plotter.scenes(m));
      figures.push_back(plotter.cost(m));
    }
    if (metrics[m].primary || unit == "mm" || unit == "deg") figures.push_back(plotter.success(m));
  }
  return figures;
}

}  // namespace dressform
