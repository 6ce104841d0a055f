#pragma once
#include <algorithm>
#include <cmath>

namespace dressform {

// Which of `count` equal sectors of a turn an angle of -pi to pi lies in.
inline int sector_of(double angle, int count) {
  return std::clamp(static_cast<int>((angle + M_PI) / (2 * M_PI) * count), 0, count - 1);
}

}  // namespace dressform
