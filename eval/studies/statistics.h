#pragma once
#include <vector>

#include "scenes/registry.h"

namespace dressform {

// Statistics of paired comparisons. A sample is one number a scene: the difference of two variants there, seeds
// averaged inside the scene. Pure functions, deterministic in (values, seed); distributions are Boost.Math's.

// Below this many scenes nothing is told by a p: the exact test of five cannot go below 0.0625.
constexpr int kFewestScenes = 6;
constexpr double kConfidence = 0.95;  // of intervals; tests are made at 1 - kConfidence
constexpr double kPower = 0.80;       // of the smallest effect that a study is said to see

struct Interval {
  double low = 0, high = 0;
};

double mean_of(const std::vector<double>& values);       // NaN for none
double deviation_of(const std::vector<double>& values);  // of a sample (n - 1); NaN for fewer than two

// Wilson's score interval of a success rate (JASA 1927). Throws std::logic_error unless 0 <= successes <= trials > 0.
Interval wilson_interval(int successes, int trials, double confidence = kConfidence);

// Bootstrap-t interval of the mean (Efron and Tibshirani, An Introduction to the Bootstrap, 1993, section 12.5):
// resampled means in units of their own standard error, so that skewed differences get a skewed interval. Values that
// are all equal give an interval without width. Throws std::logic_error for fewer than two values.
Interval bootstrap_t_interval(const std::vector<double>& values, Seed seed, double confidence = kConfidence,
                              int resamples = 1999);

// Two-sided sign-flip (paired permutation) test of a mean of zero (Fisher, The Design of Experiments, 1935): the share
// of all ways to choose the signs in which the sum is at least as far from zero. Exact up to 20 values, above by 99,999
// seeded draws. 1 for none.
double sign_flip_p(const std::vector<double>& values, Seed seed);

// Two one-sided t tests (Schuirmann, J. Pharmacokinetics 1987): small when the mean lies within +-margin beyond doubt.
// 1 for fewer than two values or no margin.
double tost_p(const std::vector<double>& values, double margin);

// Holm's step-down adjustment (Scandinavian J. of Statistics 1979) of the p of one family, in their order.
std::vector<double> holm(const std::vector<double>& p);

// The smallest true mean that a two-sided t test of n values of this standard deviation finds with the given power.
// Infinite for fewer than two values.
double detectable_effect(int n, double deviation, double confidence = kConfidence, double power = kPower);

// Ranks of the magnitudes with the values' signs, ties sharing their mean rank, zeros 0 (Wilcoxon, Biometrics 1945).
// May be infinite: a scene on which only one side gave a number ranks beyond all others.
std::vector<double> signed_ranks(const std::vector<double>& values);

}  // namespace dressform
