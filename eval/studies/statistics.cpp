#include "eval/studies/statistics.h"

#include <algorithm>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "scenes/random.h"

namespace dressform {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMostEnumerated = 20;    // values: 2^19 choices of signs, a few milliseconds
constexpr int kDrawnSignings = 99999;  // p of 0.05 known to 0.0014

double standard_error(const std::vector<double>& values) {
  return deviation_of(values) / std::sqrt(static_cast<double>(values.size()));
}

bool all_equal(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [&](double value) { return value == values.front(); });
}

// Whole numbers below `count`, four a step of the counter-based generator.
class Indices {
 public:
  Indices(Seed seed, const char* stream, std::size_t count) : seed_(seed), stream_(stream_of(stream)), count_(count) {}
  std::size_t next() {
    if (used_ == 4) {
      block_ = uniform4(seed_, stream_, at_++);
      used_ = 0;
    }
    return std::min(count_ - 1, static_cast<std::size_t>(block_[used_++] * static_cast<double>(count_)));
  }

 private:
  Seed seed_;
  std::uint64_t stream_, at_ = 0;
  std::size_t count_;
  std::array<double, 4> block_{};
  int used_ = 4;
};

// The mean's distance from the truth in units of its standard error, of one resample.
double studentized(const std::vector<double>& sample, double truth) {
  const double off = mean_of(sample) - truth;
  if (!all_equal(sample)) return off / standard_error(sample);
  return off == 0 ? 0 : std::copysign(kInfinity, off);
}

// Interpolated between neighbours; an infinite neighbour is taken as it is.
double quantile_of_sorted(const std::vector<double>& sorted, double part) {
  const double place = part * static_cast<double>(sorted.size() + 1) - 1;
  const double inside = std::clamp(place, 0.0, static_cast<double>(sorted.size() - 1));
  const auto below = static_cast<std::size_t>(inside), above = std::min(below + 1, sorted.size() - 1);
  const double share = inside - static_cast<double>(below);
  if (share == 0 || !std::isfinite(sorted[below]) || !std::isfinite(sorted[above])) return sorted[below];
  return sorted[below] + share * (sorted[above] - sorted[below]);
}

// Sums that differ by rounding alone are equal.
double slack_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += std::abs(value);
  return 1e-9 * sum;
}

// All choices of signs but for the first value's (the others are their mirror images), one flip a step (Gray code).
double enumerated_p(const std::vector<double>& values) {
  const double observed = std::abs(std::accumulate(values.begin(), values.end(), 0.0)) - slack_of(values);
  const std::uint32_t count = 1u << (values.size() - 1);
  std::vector<double> sign(values.size(), 1);
  double sum = std::accumulate(values.begin(), values.end(), 0.0);
  std::uint32_t as_far = std::abs(sum) >= observed;
  for (std::uint32_t step = 1; step < count; ++step) {
    std::size_t flipped = 1;
    while (!(step >> (flipped - 1) & 1u)) ++flipped;
    sign[flipped] = -sign[flipped];
    sum += 2 * sign[flipped] * values[flipped];
    as_far += std::abs(sum) >= observed;
  }
  return static_cast<double>(as_far) / count;
}

double drawn_p(const std::vector<double>& values, Seed seed) {
  const double observed = std::abs(std::accumulate(values.begin(), values.end(), 0.0)) - slack_of(values);
  Indices coin(seed, "sign flip", 2);
  int as_far = 1;  // what was observed is one of the draws (Phipson and Smyth, SAGMB 2010)
  for (int draw = 0; draw < kDrawnSignings; ++draw) {
    double sum = 0;
    for (const double value : values) sum += coin.next() == 0 ? value : -value;
    as_far += std::abs(sum) >= observed;
  }
  return static_cast<double>(as_far) / (kDrawnSignings + 1);
}

// Of the two-sided t test when the true mean is `effect` standard deviations.
double power_of_t_test(int n, double effect, double confidence) {
  const double freedom = n - 1;
  const double limit = quantile(boost::math::students_t(freedom), 0.5 + 0.5 * confidence);
  const boost::math::non_central_t shifted(freedom, effect * std::sqrt(static_cast<double>(n)));
  return cdf(complement(shifted, limit)) + cdf(shifted, -limit);
}

}  // namespace

double mean_of(const std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double deviation_of(const std::vector<double>& values) {
  if (values.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  if (all_equal(values)) return 0;
  const double mean = mean_of(values);
  double sum = 0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

Interval wilson_interval(int successes, int trials, double confidence) {
  if (trials <= 0 || successes < 0 || successes > trials)
    throw std::logic_error("wilson_interval: expected 0 <= successes <= trials, trials > 0");
  const double z = quantile(boost::math::normal(), 0.5 + 0.5 * confidence), n = trials, rate = successes / n;
  const double middle = (rate + z * z / (2 * n)) / (1 + z * z / n);
  const double half = z / (1 + z * z / n) * std::sqrt(rate * (1 - rate) / n + z * z / (4 * n * n));
  return {successes == 0 ? 0 : middle - half, successes == trials ? 1 : middle + half};
}

Interval bootstrap_t_interval(const std::vector<double>& values, Seed seed, double confidence, int resamples) {
  if (values.size() < 2) throw std::logic_error("bootstrap_t_interval: expected two values at least");
  const double mean = mean_of(values);
  if (all_equal(values)) return {values.front(), values.front()};
  Indices index(seed, "bootstrap t", values.size());
  std::vector<double> ratios, sample(values.size());
  for (int i = 0; i < resamples; ++i) {
    for (double& value : sample) value = values[index.next()];
    ratios.push_back(studentized(sample, mean));
  }
  std::sort(ratios.begin(), ratios.end());
  const double error = standard_error(values), tail = 0.5 * (1 - confidence);
  return {mean - quantile_of_sorted(ratios, 1 - tail) * error, mean - quantile_of_sorted(ratios, tail) * error};
}

double sign_flip_p(const std::vector<double>& values, Seed seed) {
  if (values.empty()) return 1;
  return values.size() <= kMostEnumerated ? enumerated_p(values) : drawn_p(values, seed);
}

double tost_p(const std::vector<double>& values, double margin) {
  if (values.size() < 2 || !(margin > 0)) return 1;
  const double mean = mean_of(values), error = standard_error(values);
  if (error == 0) return std::abs(mean) < margin ? 0 : 1;
  const boost::math::students_t t(static_cast<double>(values.size() - 1));
  const double above_low = cdf(complement(t, (mean + margin) / error));
  const double below_high = cdf(t, (mean - margin) / error);
  return std::max(above_low, below_high);
}

std::vector<double> holm(const std::vector<double>& p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  std::vector<double> adjusted(p.size());
  double least = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    least = std::max(least, std::min(1.0, static_cast<double>(p.size() - k) * p[order[k]]));
    adjusted[order[k]] = least;
  }
  return adjusted;
}

double detectable_effect(int n, double deviation, double confidence, double power) {
  if (n < 2) return kInfinity;
  if (deviation == 0) return 0;
  double low = 0, high = 1;
  while (power_of_t_test(n, high, confidence) < power) high *= 2;
  for (int step = 0; step < 50; ++step) {
    const double middle = 0.5 * (low + high);
    (power_of_t_test(n, middle, confidence) < power ? low : high) = middle;
  }
  return high * deviation;
}

std::vector<double> signed_ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] != 0) order.push_back(i);
  const auto magnitude = [&](std::size_t place) { return std::abs(values[order[place]]); };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::abs(values[a]) < std::abs(values[b]); });
  std::vector<double> ranks(values.size(), 0);
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    while (last < order.size() && magnitude(last) == magnitude(first)) ++last;
    const double rank = 0.5 * static_cast<double>(first + 1 + last);
    for (std::size_t place = first; place < last; ++place)
      ranks[order[place]] = std::copysign(rank, values[order[place]]);
  }
  return ranks;
}

}  // namespace dressform
