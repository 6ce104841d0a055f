#include "synthetic/garments/creases.h"

#include <cmath>

#include "scenes/random.h"

namespace dressform {

std::vector<Crease> draw_creases(const std::vector<CreaseZone>& zones, double amplitude_m, Seed seed,
                                 std::uint64_t stream) {
  std::vector<Crease> creases;
  std::uint64_t index = 0;
  for (const CreaseZone& zone : zones)
    for (int i = 0; i < zone.count; ++i) {
      const auto a = uniform4(seed, stream, index++), b = uniform4(seed, stream, index++);
      Crease crease;
      crease.s = zone.s_low + a[0] * (zone.s_high - zone.s_low);
      crease.angle = 2 * M_PI * (i + a[1]) / zone.count;  // spread evenly round the tube
      crease.slant = zone.slant + (2 * a[2] - 1) * zone.slant_spread;
      crease.length_m = zone.length_m * (0.7 + 0.6 * a[3]);
      crease.width_m = zone.width_m * (0.8 + 0.5 * b[0]);
      crease.height_m = zone.height * amplitude_m * (0.5 + 0.7 * b[1]) * (b[2] < 0.25 ? -0.6 : 1);
      creases.push_back(crease);
    }
  return creases;
}

double crease_height(const std::vector<Crease>& creases, double s, double angle, double radius_m) {
  double sum = 0;
  for (const Crease& crease : creases) {
    const double up = s - crease.s;
    if (std::abs(up) > crease.length_m + 3 * crease.width_m) continue;
    const double round = std::remainder(angle - crease.angle, 2 * M_PI) * radius_m;
    const double along = round * std::cos(crease.slant) + up * std::sin(crease.slant);
    const double across = -round * std::sin(crease.slant) + up * std::cos(crease.slant);
    const double x = across / crease.width_m, y = along / (0.5 * crease.length_m);
    if (x * x > 9 || y * y > 9) continue;
    sum += crease.height_m * std::exp(-x * x - y * y);
  }
  return sum;
}

}  // namespace dressform
