#include "eval/studies/comparison.h"

#include <gtest/gtest.h>

#include "scenes/random.h"

namespace dressform {
namespace {

using State = Outcome::State;

// A baseline of mean 10 mm and a variant that is `effect` from it, differences of deviation 1 mm.
std::vector<ScenePair> simulated_pairs(int scenes, double effect, Seed seed = 1) {
  std::vector<ScenePair> pairs;
  for (int i = 0; i < scenes; ++i) {
    const double baseline = 10 + normal(seed, stream_of("baseline"), i);
    pairs.push_back({"scene" + std::to_string(i),
                     {State::measured, baseline},
                     {State::measured, baseline + effect + normal(seed, stream_of("difference"), i)}});
  }
  return pairs;
}

Comparison judged(const std::vector<ScenePair>& pairs, Better direction, double margin) {
  std::vector<Comparison> family{compared(pairs, direction, margin, 1)};
  judge_family(family, {direction});
  return family[0];
}

TEST(StudyComparison, VerdictsFollowTheDirection) {
  EXPECT_EQ(judged(simulated_pairs(12, 3), Better::lower, 0.5).verdict, Verdict::worse);
  EXPECT_EQ(judged(simulated_pairs(12, -3), Better::lower, 0.5).verdict, Verdict::better);
  EXPECT_EQ(judged(simulated_pairs(12, 3), Better::higher, 0.5).verdict, Verdict::better);
  EXPECT_EQ(judged(simulated_pairs(12, 3), Better::near_zero, 0.5).verdict, Verdict::worse);
  EXPECT_EQ(judged(simulated_pairs(12, 0), Better::lower, 0.1).verdict, Verdict::inconclusive);
  EXPECT_EQ(judged(simulated_pairs(12, 0), Better::lower, 3).verdict, Verdict::equivalent);
}

TEST(StudyComparison, AgainstItselfTwelveScenesAreEquivalentAndFourAreInconclusive) {
  std::vector<ScenePair> same = simulated_pairs(12, 0);
  for (auto& pair : same) pair.variant = pair.baseline;
  const Comparison twelve = judged(same, Better::lower, 0.01);
  EXPECT_EQ(twelve.verdict, Verdict::equivalent);
  EXPECT_EQ(twelve.effect, 0);
  EXPECT_EQ(*twelve.p, 1);
  same.resize(4);
  const Comparison four = judged(same, Better::lower, 0.01);
  EXPECT_EQ(four.verdict, Verdict::inconclusive);
  EXPECT_FALSE(four.p);
  EXPECT_FALSE(four.p_equivalent);
}

TEST(StudyComparison, ALargeEffectOnFiveScenesIsStillInconclusive) {
  const Comparison five = judged(simulated_pairs(5, 50), Better::lower, 0.5);
  EXPECT_EQ(five.verdict, Verdict::inconclusive);
  EXPECT_TRUE(five.interval);  // shown all the same
  EXPECT_GT(five.interval->low, 40);
}

TEST(StudyComparison, EffectIntervalAndSmallestEffect) {
  const Comparison result = judged(simulated_pairs(12, 3), Better::lower, 0.5);
  EXPECT_NEAR(result.effect, 3, 1);
  EXPECT_LT(result.interval->low, result.effect);
  EXPECT_GT(result.interval->high, result.effect);
  EXPECT_NEAR(result.variant_mean - result.baseline_mean, result.effect, 1e-9);
}

TEST(StudyComparison, SmallestEffectIsThatOfTheDifferences) {
  std::vector<ScenePair> pairs = simulated_pairs(12, 0);
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].variant.value = pairs[i].baseline.value + (i % 2 ? 1 : -1);
  // Differences of 1 and -1, deviation sqrt(12 / 11): 0.89 of that.
  EXPECT_NEAR(judged(pairs, Better::lower, 0).detectable, 0.93, 0.01);
}

TEST(StudyComparison, FailuresAreCountedThreeWays) {
  auto pairs = simulated_pairs(12, -3);  // the variant is better where it gives anything
  for (int i : {0, 3, 5, 7}) pairs[i].variant.state = State::failed;
  pairs[3].baseline.state = State::failed;
  pairs[11].baseline.state = pairs[11].variant.state = State::absent;
  const Comparison result = judged(pairs, Better::lower, 0.5);
  EXPECT_EQ(result.pairs(), 7);
  EXPECT_EQ(result.variant_success.successes, 7);
  EXPECT_EQ(result.variant_success.trials, 11);
  EXPECT_EQ(result.baseline_success.successes, 10);
  EXPECT_GT(result.variant_success.interval.low, 0.3);
  EXPECT_LT(result.variant_success.interval.high, 0.9);
  EXPECT_EQ(result.with_failures.better, 7);
  EXPECT_EQ(result.with_failures.worse, 3);
  EXPECT_EQ(result.with_failures.equal, 1);
  EXPECT_GT(*result.with_failures.p, 0.5);  // the three worst ranks weigh against the seven gains
  EXPECT_EQ(result.verdict, Verdict::better);
}

TEST(StudyComparison, AVariantThatAlwaysFailsHasNoPairAndIsWorse) {
  auto pairs = simulated_pairs(12, 0);
  for (auto& pair : pairs) pair.variant.state = State::failed;
  const Comparison result = judged(pairs, Better::lower, 0.5);
  EXPECT_EQ(result.pairs(), 0);
  EXPECT_EQ(result.variant_success.successes, 0);
  EXPECT_EQ(result.with_failures.worse, 12);
  EXPECT_LT(*result.with_failures.p, 0.001);
  EXPECT_EQ(result.verdict, Verdict::worse);
}

TEST(StudyComparison, HolmIsOverTheFamily) {
  // Six scenes of one sign: p = 1/32 alone, 3/32 beside two that say nothing.
  std::vector<ScenePair> clear = simulated_pairs(6, -20);
  std::vector<Comparison> family{compared(clear, Better::lower, 0, 1),
                                 compared(simulated_pairs(6, 0, 2), Better::lower, 0, 1),
                                 compared(simulated_pairs(6, 0, 3), Better::lower, 0, 1)};
  judge_family(family, {Better::lower, Better::lower, Better::lower});
  EXPECT_DOUBLE_EQ(*family[0].p, 1.0 / 32);
  EXPECT_DOUBLE_EQ(*family[0].p_holm, 3.0 / 32);
  EXPECT_EQ(family[0].verdict, Verdict::inconclusive);
  EXPECT_EQ(judged(clear, Better::lower, 0).verdict, Verdict::better);
}

// How often the verdict of an A/A comparison is wrong, on studies of 12 scenes: at most its level.
TEST(StudyComparison, VerdictsOfNothingAreSeldomWrong) {
  int wrong = 0;
  const int studies = 200;
  for (int study = 0; study < studies; ++study) {
    const Verdict verdict = judged(simulated_pairs(12, 0, 100 + study), Better::lower, 0.2).verdict;
    wrong += verdict == Verdict::better || verdict == Verdict::worse;
  }
  EXPECT_LE(wrong, studies * 0.08);
}

}  // namespace
}  // namespace dressform
