#pragma once
#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

namespace dressform {

// Order statistics that are values of the list itself, never a mean of two: the same bytes whatever order the values
// come in. (Interpolated quantiles of scores: eval/metrics/sampling.h.)

// The value at a place of the list in ascending order (0: the least). Throws std::logic_error when there is no such
// place.
template <class T>
T nth_value(std::vector<T> values, std::size_t place) {
  if (place >= values.size()) throw std::logic_error("nth_value: no such place");
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// The upper median: of an even number of values the greater of the two in the middle. Throws std::logic_error for none.
template <class T>
T median(std::vector<T> values) {
  const std::size_t middle = values.size() / 2;
  return nth_value(std::move(values), middle);
}

template <class T>
T median_or(std::vector<T> values, T otherwise) {
  return values.empty() ? otherwise : median(std::move(values));
}

// The value that `part` (0 to 1) of the others lie below, rounded down to one that occurs. Throws std::logic_error for
// none.
template <class T>
T lower_quantile(std::vector<T> values, double part) {
  if (values.empty()) throw std::logic_error("lower_quantile: no values");
  const auto place = static_cast<std::size_t>(part * static_cast<double>(values.size() - 1));
  return nth_value(std::move(values), place);
}

// Standard deviation of normal noise over the median of its magnitudes.
constexpr double kSigmaPerMedianDeviation = 1.4826;

// Tukey's biweight (Beaton and Tukey, Technometrics 1974): weight and loss of a residual over the constant beyond which
// it weighs nothing; the loss saturates at 1 there.
struct Tukey {
  double weight = 0, loss = 1;
  explicit Tukey(double ratio) : Tukey(of_square(ratio * ratio)) {}
  static Tukey of_square(double squared_ratio) {
    const double u = std::max(0.0, 1 - squared_ratio);
    return Tukey(u * u, 1 - u * u * u);
  }

 private:
  Tukey(double weight, double loss) : weight(weight), loss(loss) {}
};

}  // namespace dressform
