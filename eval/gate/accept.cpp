#include "eval/gate/accept.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <set>

#include "eval/score/targets.h"
#include "scenes/error.h"

namespace dressform {
namespace {

std::string row_item(const ScoreRow& row) { return row.stage + " " + row.metric; }

// What an accept takes: everything, or what was named.
class Choice {
 public:
  explicit Choice(const AcceptRequest& request) : items_(request.items.begin(), request.items.end()) {}
  bool in_bulk() const { return items_.empty(); }
  bool names(const std::string& item) const { return items_.count(item) > 0; }
  bool covers(const std::string& item) const { return in_bulk() || names(item); }
  const std::set<std::string>& items() const { return items_; }

 private:
  std::set<std::string> items_;
};

// Every named item is a number or an image of the run, or a number of the reference that the run no longer has.
void check_items(const Choice& choice, const GoldenCase& golden, const GoldenRun& run) {
  std::set<std::string> known;
  for (const auto& row : run.scores.rows) known.insert(row_item(row));
  for (const auto& [stem, image] : run.images) known.insert("image " + stem);
  for (const auto& score : golden.scores) known.insert(row_item(score.row));
  for (const auto& [stem, image] : golden.images) known.insert("image " + stem);
  for (const auto& item : choice.items())
    if (!known.count(item))
      throw InputError("--item " + item,
                       "is no number or image of this run; expected \"STAGE METRIC\" or \"image NAME\" as `gate check` "
                       "prints them, e.g. \"surface top/f_5mm@1\"");
}

// The misses of a run, each with its reason; of targets that the accept does not cover, those known before.
std::map<std::string, std::string> explained_misses(const GoldenCase& golden, const GoldenRun& run,
                                                    const AcceptRequest& request, const Choice& choice) {
  std::map<std::string, std::string> misses;
  std::string without, example;
  for (const auto& each : target_results(run.scores)) {
    if (each.met) continue;
    const auto given = request.miss_reasons.find(each.name()), known = golden.known_misses.find(each.name());
    if (given != request.miss_reasons.end() && !given->second.empty()) {
      misses[each.name()] = given->second;
    } else if (known != golden.known_misses.end()) {
      misses[each.name()] = known->second;
    } else if (choice.covers(each.name())) {
      without += fmt::format("{}{} ({}, target {})", without.empty() ? "" : ", ", each.name(), each.value_text(),
                             each.metric->target_text());
      if (example.empty()) example = each.name();
    }
  }
  if (!without.empty())
    throw InputError("--miss", fmt::format("no reason given for missed targets: {}; expected one each, --miss "
                                           "\"{}=why it is missed\"",
                                           without, example));
  for (const auto& [metric, reason] : request.miss_reasons)
    if (!misses.count(metric)) throw InputError("--miss " + metric, "is no target that this run misses");
  if (!choice.in_bulk())
    for (const auto& [metric, reason] : golden.known_misses)
      if (!choice.names(metric)) misses.emplace(metric, reason);  // not this accept's business
  return misses;
}

const GoldenScore* find_score(const GoldenCase& golden, const std::string& item) {
  const auto found = std::find_if(golden.scores.begin(), golden.scores.end(),
                                  [&](const GoldenScore& each) { return row_item(each.row) == item; });
  return found == golden.scores.end() ? nullptr : &*found;
}

ItemVerdict verdict_of(const GateResult& checked, const std::string& item) {
  for (const auto& each : checked.items)
    if (each.what() == item) return each.verdict;
  return ItemVerdict::unknown;
}

// The number as accepted now. A step that nobody can overlook, or that was named, was taken knowingly: it is no creep.
GoldenScore accepted_score(const ScoreRow& row, const GoldenScore* old, double tolerance, bool named) {
  GoldenScore score{row, nuisance_tolerance(row), row.value, 0};
  score.row.n_samples = 0;
  if (!old || !std::isfinite(old->first)) return score;
  score.first = old->first;
  score.known_drift = old->known_drift;
  if (!std::isfinite(row.value)) return score;
  const double drift = worsening(row, old->first, row.value);
  const bool leap = worsening(row, old->row.value, row.value) > kCreepTolerances * tolerance;
  if (named || leap) score.known_drift = std::max(0.0, drift);
  return score;
}

// Takes the scores; gives the changes for the history.
std::string accept_scores(const GoldenRun& run, const GateResult& checked, const Choice& choice,
                          const MeasuredNuisance& nuisance, const GoldenCase& golden, Accepted& result) {
  std::string changes;
  const auto keep = [&](const GoldenScore* old) {
    if (old) result.golden.scores.push_back(*old);
  };
  result.golden.scores.clear();
  for (const auto& row : run.scores.rows) {
    const std::string item = row_item(row);
    const GoldenScore* old = find_score(golden, item);
    const ItemVerdict verdict = verdict_of(checked, item);
    const bool changed = verdict != ItemVerdict::same && verdict != ItemVerdict::within;
    if (!choice.covers(item) || (choice.in_bulk() && old && !changed)) {
      keep(old);
      continue;
    }
    const double tolerance = old ? nuisance.tolerance(row).value_or(old->tolerance) : 0;
    const GoldenScore next = accepted_score(row, old, tolerance, choice.names(item));
    const double drift = old && std::isfinite(next.first) ? worsening(row, next.first, row.value) : 0;
    const bool a_step = old && worsening(row, next.first, old->row.value) > 0;  // not the first one
    if (choice.in_bulk() && a_step && drift - next.known_drift > kCreepTolerances * tolerance) {
      result.left.push_back(item);
      keep(old);
      continue;
    }
    result.golden.scores.push_back(next);
    if (old && (old->row.status != row.status || old->row.value != row.value))
      changes += fmt::format("; {}: {:.6g} -> {:.6g}", item, old->row.value, row.value);
  }
  for (const auto& score : golden.scores)  // what the run no longer has stays unless the accept covers it
    if (!run.scores.find(score.row.stage, score.row.metric) && !choice.covers(row_item(score.row))) keep(&score);
  return changes;
}

void accept_images(const GoldenRun& run, const GateResult& checked, const Choice& choice, GoldenCase& golden) {
  for (const auto& [stem, image] : run.images) {
    const std::string item = "image " + stem;
    const ItemVerdict verdict = verdict_of(checked, item);
    const bool changed = verdict != ItemVerdict::same && verdict != ItemVerdict::within;
    if (!choice.covers(item) || (choice.in_bulk() && !changed)) continue;
    const auto old = golden.images.find(stem);
    if (old != golden.images.end()) golden.image_drift[stem] += picture_difference(old->second, image).flip;
    golden.images[stem] = image;
  }
  for (auto it = golden.images.begin(); it != golden.images.end();) {
    const bool gone = !run.images.count(it->first) && choice.covers("image " + it->first);
    it = gone ? golden.images.erase(it) : std::next(it);
  }
}

}  // namespace

Accepted accepted(const GoldenCase& golden, const GoldenRun& run, const AcceptRequest& request,
                  const MeasuredNuisance& nuisance) {
  const Choice choice(request);
  check_items(choice, golden, run);
  const GateResult checked = compare_with_golden(golden, run, nuisance);
  Accepted result{golden, {}};
  result.golden.known_misses = explained_misses(golden, run, request, choice);
  const std::string changes = accept_scores(run, checked, choice, nuisance, golden, result);
  accept_images(run, checked, choice, result.golden);
  result.golden.history.push_back(request.reason + changes);
  // Bytes stand for all of a run: they are kept when all of it is accepted.
  if (compare_with_golden(result.golden, run, nuisance).verdict == GateVerdict::pass) {
    result.golden.steps = run.steps;
    result.golden.environment = run.environment;
  }
  return result;
}

cv::Mat comparison_strip(const cv::Mat& now, const cv::Mat& reference) {
  if (now.size() != reference.size() || now.type() != reference.type()) return now;
  cv::Mat difference, row;
  cv::absdiff(now, reference, difference);
  cv::hconcat(std::vector<cv::Mat>{now, reference, difference * 10}, row);
  return row;
}

}  // namespace dressform
