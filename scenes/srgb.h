#pragma once
#include <cmath>

namespace dressform {

// The transfer curve of sRGB (IEC 61966-2-1) for one channel, 0 to 1.
template <class T>
T linear_of_srgb(T level) {
  return level <= T(0.04045) ? level / T(12.92) : std::pow((level + T(0.055)) / T(1.055), T(2.4));
}
template <class T>
T srgb_of_linear(T linear) {
  return linear <= T(0.0031308) ? T(12.92) * linear : T(1.055) * std::pow(linear, 1 / T(2.4)) - T(0.055);
}

// The same for values that may lie outside 0 to 1: they are clamped first.
float linear_from_srgb(float value);
float srgb_from_linear(float value);

}  // namespace dressform
