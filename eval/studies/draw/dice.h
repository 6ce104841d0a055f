#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "scenes/random.h"
#include "scenes/registry.h"

namespace dressform {

// The draws of one scene, each by its name: one that is asked for or left out changes no other.
class Dice {
 public:
  explicit Dice(Seed seed, std::string prefix = "") : seed_(seed), prefix_(std::move(prefix)) {}

  // Of a part of the scene: its names are its own.
  Dice part(const std::string& name) const { return Dice(seed_, prefix_ + name + "/"); }

  // Rounded to `digits` decimals, so that the file says exactly what was drawn.
  double between(const std::string& name, double low, double high, int digits = 3) const {
    return rounded(low + (high - low) * roll(name), digits);
  }
  double normal_about(const std::string& name, double mean, double deviation, int digits = 3) const {
    const double off = std::clamp(normal(seed_, stream(name), 0), -2.5, 2.5);
    return rounded(mean + deviation * off, digits);
  }
  bool chance(const std::string& name, double probability) const { return roll(name) < probability; }
  int whole(const std::string& name, int low, int high) const {
    return std::min(high, low + static_cast<int>(roll(name) * (high - low + 1)));
  }
  template <class T>
  const T& one_of(const std::string& name, const std::vector<T>& list) const {
    return list[static_cast<std::size_t>(whole(name, 0, static_cast<int>(list.size()) - 1))];
  }
  // The first whose weight the roll falls into. Weights need not sum to 1.
  std::string weighted(const std::string& name, const std::vector<std::pair<std::string, double>>& weights) const {
    double sum = 0;
    for (const auto& [word, weight] : weights) sum += weight;
    double left = roll(name) * sum;
    for (const auto& [word, weight] : weights)
      if ((left -= weight) < 0) return word;
    return weights.back().first;
  }

  static double rounded(double value, int digits) {
    const double unit = std::pow(10, digits);
    return std::round(value * unit) / unit;
  }

 private:
  std::uint64_t stream(const std::string& name) const { return stream_of((prefix_ + name).c_str()); }
  double roll(const std::string& name) const { return uniform(seed_, stream(name), 0); }
  Seed seed_;
  std::string prefix_;
};

}  // namespace dressform
