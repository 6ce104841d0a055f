#include "eval/studies/study_metric.h"

#include <fmt/format.h>

#include <cmath>

#include "scenes/error.h"

namespace dressform {
namespace {

std::string versioned(const Metric& metric) { return fmt::format("{}@{}", metric.name, metric.version); }

const Metric* declared(const std::string& stage, const std::string& row) {
  if (row.find('<') == std::string::npos) return find_metric(stage, row);
  for (const Metric* metric : all_metrics())
    if (metric->stage == stage && versioned(*metric) == row) return metric;
  return nullptr;
}

// The declared names of a stage, or the stages where that is not known either.
std::string known_names(const std::string& stage) {
  std::string names, stages, last;
  for (const Metric* metric : all_metrics()) {
    if (metric->stage == stage) names += (names.empty() ? "" : ", ") + versioned(*metric);
    if (metric->stage != last) stages += (stages.empty() ? "" : ", ") + metric->stage;
    last = metric->stage;
  }
  return names.empty() ? "a stage of " + stages : "one of " + names;
}

}  // namespace

bool StudyMetric::takes(const ScoreRow& score) const {
  if (score.stage != stage) return false;
  return whole_family() ? find_metric(score.stage, score.metric) == metric : score.metric == row;
}

StudyMetric study_metric(const std::string& where, const std::string& text) {
  const auto space = text.find(' ');
  if (space == std::string::npos)
    throw InputError(where, fmt::format("found \"{}\"; expected stage and row, e.g. \"surface <slot>/f_5mm@1\" "
                                        "(dressform metrics)",
                                        text));
  StudyMetric result;
  result.text = text;
  result.stage = text.substr(0, space);
  result.row = text.substr(space + 1);
  result.metric = declared(result.stage, result.row);
  if (!result.metric)
    throw InputError(where,
                     fmt::format("found \"{}\", which is not declared; expected {}", text, known_names(result.stage)));
  if (result.metric->better == Better::neither)
    throw InputError(where, fmt::format("found \"{}\", which describes and has no better and worse; expected a metric "
                                        "with a direction",
                                        text));
  return result;
}

Outcome outcome_of(const StudyMetric& metric, const std::vector<ScoreRow>& rows) {
  std::vector<double> values;
  for (const auto& row : rows) {
    if (!metric.takes(row) || row.status == "absent") continue;
    if (row.status != "ok") return {Outcome::State::failed, 0};
    values.push_back(metric.metric->better == Better::near_zero ? std::abs(row.value) : row.value);
  }
  if (values.empty()) return {};
  return {Outcome::State::measured, mean_of(values)};
}

std::string difference_text(const StudyMetric& metric, double value) {
  if (!std::isfinite(value)) return "-";
  const std::string& unit = metric.metric->unit;
  const bool bare = unit == "1" || unit == "count";
  return fmt::format(std::abs(value) < 1 ? "{:+.3f}{}" : "{:+.2f}{}", value, bare ? "" : " " + unit);
}

}  // namespace dressform
