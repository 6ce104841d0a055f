#include "eval/report/score_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "eval/score/targets.h"

namespace dressform {
namespace {

const std::string kSlot = "<slot>";

// The metric's words with the members of its row: "ease change, <tape>" and {"top", "chest"}.
std::string headline_of(const Metric& metric, const std::vector<std::string>& members) {
  std::string words = metric.headline;
  std::size_t at = 0;
  for (const auto& member : members) {
    at = metric.name.find('<', at);
    const std::string family = metric.name.substr(at, metric.name.find('>', at) - at + 1);
    if (const auto found = words.find(family); found != std::string::npos) words.replace(found, family.size(), member);
    ++at;
  }
  return words;
}

// The garment that a row belongs to, or the stage that it judges.
std::string part_of(const Metric& metric, const std::vector<std::string>& members) {
  return metric.name.rfind(kSlot + "/", 0) == 0 ? members[0] : metric.stage;
}

// Registration and bodies first, then all of the top, then all of the bottom.
int rank_of(const std::string& part) { return part == "bottom" ? 2 : part == "top" ? 1 : 0; }

ScoreLine line_of(const Metric& metric, const ScoreRow& row, const std::vector<std::string>& members) {
  ScoreLine line;
  line.part = part_of(metric, members);
  line.measure = headline_of(metric, members);
  line.value = value_text(row);
  if (!metric.target || row.status == "absent") return line;
  line.target = metric.target_text();
  line.from_scale = metric.from_scale;
  line.state = row.status == "ok" && metric.meets_target(row.value) ? ScoreLine::State::met : ScoreLine::State::missed;
  return line;
}

}  // namespace

std::vector<ScoreLine> score_lines(const Scores& scores) {
  const auto metrics = all_metrics();
  const auto place = [&](const Metric* metric) {
    return std::find(metrics.begin(), metrics.end(), metric) - metrics.begin();
  };
  std::multimap<std::pair<int, std::ptrdiff_t>, ScoreLine> ordered;  // rows of one metric stay in their order
  for (const auto& row : scores.rows) {
    const Metric* metric = find_metric(row.stage, row.metric);
    if (!metric || metric->headline.empty()) continue;
    const auto members = *metric->members_of(row.metric);
    if (!metric->judges(members)) continue;
    const ScoreLine line = line_of(*metric, row, members);
    ordered.emplace(std::pair(rank_of(line.part), place(metric)), line);
  }
  std::vector<ScoreLine> lines;
  for (const auto& [key, line] : ordered) lines.push_back(line);
  return lines;
}

TargetCount count_targets(const std::vector<ScoreLine>& lines, std::optional<double> scale) {
  TargetCount count;
  for (const auto& line : lines) {
    count.judged += line.judged();
    count.missed += line.missed();
    count.missed_below_scale += line.missed() && scale && *scale < line.from_scale;
  }
  return count;
}

std::string score_table_text(const Scores& scores, std::optional<double> scale) {
  std::string text = fmt::format("scores of {} (seed {}, {})\n", scores.scene, scores.seed, scores.variant);
  const auto lines = score_lines(scores);
  for (const auto& line : lines)
    text += fmt::format("  {:<13} {:<27} {:>12}  {:<14} {}\n", line.part, line.measure, line.value, line.target,
                        line.missed() ? "MISSED" : "");
  const TargetCount count = count_targets(lines, scale);
  text += fmt::format("{} of {} targets met", count.judged - count.missed, count.judged);
  if (count.missed_below_scale)
    text += fmt::format("; {} of the missed are meant to hold at a larger scale than {:g} only",
                        count.missed_below_scale, *scale);
  return text;
}

}  // namespace dressform
