#include "render/ticks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dressform {

double round_step(double range, int most) {
  const double raw = range / most, power = std::pow(10, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= raw * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

std::string tick_text(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", std::min(decimals, 9), std::abs(value) < 1e-12 ? 0.0 : value);
  return text;
}

}  // namespace dressform
