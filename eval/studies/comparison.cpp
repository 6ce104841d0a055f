#include "eval/studies/comparison.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace dressform {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool measured(const Outcome& outcome) { return outcome.state == Outcome::State::measured; }

// 1 where larger values are better, -1 where smaller ones are. What should be near zero is given as its magnitude.
double sign_of(Better direction) {
  if (direction == Better::neither) throw std::logic_error("a metric without a direction cannot be compared");
  return direction == Better::higher ? 1 : -1;
}

// Of the scenes on which the truth has something to measure.
SuccessRate success_rate(const std::vector<ScenePair>& pairs, Outcome ScenePair::*side) {
  SuccessRate rate;
  for (const auto& pair : pairs) {
    if ((pair.*side).state == Outcome::State::absent) continue;
    ++rate.trials;
    rate.successes += measured(pair.*side);
  }
  if (rate.trials > 0) rate.interval = wilson_interval(rate.successes, rate.trials);
  return rate;
}

// How much better the variant is; infinite where one side alone gave a number, 0 where neither did.
double gain_with_failures(const ScenePair& pair, double sign) {
  if (measured(pair.baseline) && measured(pair.variant)) return sign * (pair.variant.value - pair.baseline.value);
  return measured(pair.variant) ? kInfinity : measured(pair.baseline) ? -kInfinity : 0;
}

Comparison::WithFailures with_failures(const std::vector<ScenePair>& pairs, double sign, Seed seed) {
  std::vector<double> gains;
  Comparison::WithFailures result;
  for (const auto& pair : pairs) {
    if (pair.baseline.state == Outcome::State::absent || pair.variant.state == Outcome::State::absent) continue;
    gains.push_back(gain_with_failures(pair, sign));
    (gains.back() > 0 ? result.better : gains.back() < 0 ? result.worse : result.equal) += 1;
  }
  if (static_cast<int>(gains.size()) >= kFewestScenes) result.p = sign_flip_p(signed_ranks(gains), seed);
  return result;
}

// Whether it fails so much more often that it is worse over all scenes, failures the worst rank.
bool fails_more(const Comparison& comparison) {
  const auto& all = comparison.with_failures;
  return comparison.variant_success.successes < comparison.baseline_success.successes && all.worse > all.better &&
         all.p && *all.p < 1 - kConfidence;
}

Verdict verdict_of_pairs(const Comparison& comparison, Better direction) {
  const double level = 1 - kConfidence;
  if (!comparison.p_holm) return Verdict::inconclusive;
  if (comparison.p_equivalent && *comparison.p_equivalent < level) return Verdict::equivalent;
  if (*comparison.p_holm >= level) return Verdict::inconclusive;
  return sign_of(direction) * comparison.effect > 0 ? Verdict::better : Verdict::worse;
}

// The complete pairs tell, but what they say of the scenes that are left does not hide the others.
Verdict verdict_of(const Comparison& comparison, Better direction) {
  const Verdict pairs = verdict_of_pairs(comparison, direction);
  if (!fails_more(comparison)) return pairs;
  return pairs == Verdict::better ? Verdict::inconclusive : Verdict::worse;
}

}  // namespace

std::string to_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::better:
      return "better";
    case Verdict::worse:
      return "worse";
    case Verdict::equivalent:
      return "equivalent";
    case Verdict::inconclusive:
      break;
  }
  return "inconclusive";
}

Comparison compared(const std::vector<ScenePair>& pairs, Better direction, double margin, Seed seed) {
  Comparison result;
  std::vector<double> baseline, variant, differences;
  for (const auto& pair : pairs) {
    if (!measured(pair.baseline) || !measured(pair.variant)) continue;
    baseline.push_back(pair.baseline.value);
    variant.push_back(pair.variant.value);
    differences.push_back(pair.variant.value - pair.baseline.value);
    result.differences.push_back({pair.scene, differences.back()});
  }
  result.baseline_mean = mean_of(baseline);
  result.variant_mean = mean_of(variant);
  result.effect = mean_of(differences);
  result.detectable = detectable_effect(result.pairs(), deviation_of(differences));
  if (result.pairs() >= 2) result.interval = bootstrap_t_interval(differences, seed);
  if (result.pairs() >= kFewestScenes) {
    result.p = sign_flip_p(differences, seed);
    if (margin > 0) result.p_equivalent = tost_p(differences, margin);
  }
  result.baseline_success = success_rate(pairs, &ScenePair::baseline);
  result.variant_success = success_rate(pairs, &ScenePair::variant);
  result.with_failures = with_failures(pairs, sign_of(direction), seed);
  return result;
}

void judge_family(std::vector<Comparison>& family, const std::vector<Better>& directions) {
  std::vector<double> known;
  for (const auto& comparison : family)
    if (comparison.p) known.push_back(*comparison.p);
  const std::vector<double> adjusted = holm(known);
  std::size_t next = 0;
  for (std::size_t i = 0; i < family.size(); ++i) {
    if (family[i].p) family[i].p_holm = adjusted[next++];
    family[i].verdict = verdict_of(family[i], directions.at(i));
  }
}

}  // namespace dressform
