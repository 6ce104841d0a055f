#include "scenes/random.h"

#include <Random123/philox.h>

#include <cmath>

namespace dressform {

std::array<double, 4> uniform4(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
  r123::Philox4x32::ctr_type counter = {{static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32),
                                         static_cast<std::uint32_t>(stream), static_cast<std::uint32_t>(stream >> 32)}};
  r123::Philox4x32::key_type key = {{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}};
  const auto bits = r123::Philox4x32{}(counter, key);
  std::array<double, 4> result{};
  for (int i = 0; i < 4; ++i) result[i] = (bits[i] + 0.5) * 0x1p-32;
  return result;
}

std::array<double, 4> normal4(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
  const auto u = uniform4(seed, stream, index);
  const double radius0 = std::sqrt(-2.0 * std::log(u[0])), angle0 = 2.0 * M_PI * u[1];
  const double radius1 = std::sqrt(-2.0 * std::log(u[2])), angle1 = 2.0 * M_PI * u[3];
  return {radius0 * std::cos(angle0), radius0 * std::sin(angle0), radius1 * std::cos(angle1),
          radius1 * std::sin(angle1)};
}

}  // namespace dressform
