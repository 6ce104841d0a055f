#include "eval/studies/study_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "eval/score/targets.h"
#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

constexpr Seed kBootstrapSeed = 1;  // the same interval whoever draws the report

void check_one_signature(const StudyResults& results, const fs::path& folder) {
  for (const auto& [id, cell] : results.cells) {
    const std::string other = difference_of(results.signature, cell.signature);
    if (!other.empty())
      throw InputError(cell_file(folder, id).string(),
                       "has another signature than " + results.cells.begin()->first + " (" + other +
                           "); expected cells of one program: numbers of different ones are not compared "
                           "(`dressform study run --renew`)");
  }
}

// Cells may be of several commits whose code is the same: all of them are named.
void name_commits(StudyResults& results) {
  std::set<std::string> commits;
  for (const auto& [id, cell] : results.cells)
    if (const auto found = cell.signature.find("commit"); found != cell.signature.end()) commits.insert(found->second);
  if (!commits.empty()) results.signature["commit"] = fmt::format("{}", fmt::join(commits, " and "));
}

std::size_t index_of(const Study& study, const std::string& variant) {
  for (std::size_t v = 0; v < study.variants.size(); ++v)
    if (study.variants[v].name == variant) return v;
  throw std::logic_error("a study's baseline is one of its variants");
}

std::vector<ScenePair> pairs_of(const StudyResults& results, std::size_t baseline, std::size_t variant,
                                const StudyMetric& metric) {
  std::vector<ScenePair> pairs;
  for (std::size_t s = 0; s < results.plan.scenes.size(); ++s)
    pairs.push_back(
        {results.plan.scenes[s].name, results.outcome(baseline, s, metric), results.outcome(variant, s, metric)});
  return pairs;
}

void count_cells(const StudyResults& results, VariantSummary& summary) {
  for (std::size_t s = 0; s < results.plan.scenes.size(); ++s)
    for (const auto* cell : results.cells_of(summary.variant, s)) {
      if (!cell) continue;
      ++summary.cells;
      summary.failed += cell->failed;
    }
}

VariantSummary summary_of(const StudyResults& results, std::size_t baseline, std::size_t variant) {
  VariantSummary summary;
  summary.variant = variant;
  std::vector<Comparison> primary;
  std::vector<Better> directions;
  for (const auto& metric : results.plan.study.metrics) {
    const Better better = metric.metric->better;
    summary.comparisons.push_back(
        compared(pairs_of(results, baseline, variant, metric), better, metric.margin, kBootstrapSeed));
    if (metric.primary) primary.push_back(summary.comparisons.back()), directions.push_back(better);
  }
  judge_family(primary, directions);
  std::copy(primary.begin(), primary.end(), summary.comparisons.begin());  // primary metrics come first
  count_cells(results, summary);
  summary.seconds = results.pipeline_seconds(variant);
  return summary;
}

// Verdict first, then how much better.
std::tuple<int, double> rank_of(const VariantSummary& summary, Better direction) {
  const Comparison& first = summary.comparisons.front();
  const int verdict = first.verdict == Verdict::better         ? 0
                      : first.verdict == Verdict::equivalent   ? 1
                      : first.verdict == Verdict::inconclusive ? 2
                                                               : 3;
  const double gain = direction == Better::higher ? first.effect : -first.effect;
  return {verdict, std::isfinite(gain) ? -gain : std::numeric_limits<double>::infinity()};
}

}  // namespace

std::vector<const CellResult*> StudyResults::cells_of(std::size_t variant, std::size_t scene) const {
  std::vector<const CellResult*> found;
  for (const auto& each : planned) {
    if (each.variant != variant || each.scene != scene) continue;
    const auto cell = cells.find(each.id);
    found.push_back(cell == cells.end() ? nullptr : &cell->second);
  }
  return found;
}

Outcome StudyResults::outcome(std::size_t variant, std::size_t scene, const StudyMetric& metric) const {
  std::vector<double> values;
  bool absent = false;
  for (const auto* cell : cells_of(variant, scene)) {
    if (!cell) return {};
    const Outcome each = cell->failed ? Outcome{Outcome::State::failed, 0} : outcome_of(metric, cell->scores);
    if (each.state == Outcome::State::failed) return each;
    absent = absent || each.state == Outcome::State::absent;
    values.push_back(each.value);
  }
  if (absent || values.empty()) return {};
  return {Outcome::State::measured, mean_of(values)};
}

std::optional<double> StudyResults::pipeline_seconds(std::size_t variant) const {
  std::vector<double> seconds;
  for (const auto& each : planned) {
    const auto cost = costs.find(each.id);
    if (each.variant == variant && cost != costs.end() && !cost->second.stage_seconds.empty())
      seconds.push_back(cost->second.pipeline_seconds());
  }
  if (seconds.empty()) return {};
  return mean_of(seconds);
}

StudyResults read_results(const fs::path& folder) {
  StudyResults results;
  results.plan = read_plan(folder);
  results.planned = cells_of(results.plan, folder);
  for (const auto& each : results.planned) {
    const fs::path file = cell_file(folder, each.id);
    if (results.cells.count(each.id) || !fs::exists(file)) continue;
    results.cells.emplace(each.id, read_cell(file));
    if (const auto cost = read_cost(cost_file(folder, each.id))) results.costs.emplace(each.id, *cost);
  }
  if (results.cells.empty())
    throw InputError(folder.string(), "has no cell yet; expected some made by `dressform study run`");
  results.signature = results.cells.begin()->second.signature;
  check_one_signature(results, folder);
  name_commits(results);
  return results;
}

std::vector<VariantSummary> compare_variants(const StudyResults& results) {
  const Study& study = results.plan.study;
  const std::size_t baseline = index_of(study, study.baseline);
  std::vector<VariantSummary> summaries;
  for (std::size_t v = 0; v < study.variants.size(); ++v)
    if (v != baseline) summaries.push_back(summary_of(results, baseline, v));
  const Better direction = study.metrics.front().metric->better;
  std::stable_sort(summaries.begin(), summaries.end(), [&](const VariantSummary& a, const VariantSummary& b) {
    return rank_of(a, direction) < rank_of(b, direction);
  });
  summaries.insert(summaries.begin(), summary_of(results, baseline, baseline));
  return summaries;
}

TargetsMet count_targets(const StudyResults& results, std::size_t variant, const std::string& stratum) {
  TargetsMet count;
  for (std::size_t s = 0; s < results.plan.scenes.size(); ++s) {
    const auto& strata = results.plan.scenes[s].strata;
    if (!stratum.empty() && std::find(strata.begin(), strata.end(), stratum) == strata.end()) continue;
    bool judged = false, all_met = true;
    for (const auto* cell : results.cells_of(variant, s)) {
      if (!cell) continue;
      judged = judged || cell->failed || !cell->scores.empty();
      all_met = all_met && !cell->failed;
      Scores scores;
      scores.rows = cell->scores;
      for (const auto& target : target_results(scores)) {
        if (cell->scale < target.metric->from_scale) continue;
        ++count.asked;
        count.met += target.met;
        all_met = all_met && target.met;
      }
    }
    count.scenes += judged;
    count.all_met += judged && all_met;
  }
  return count;
}

}  // namespace dressform
