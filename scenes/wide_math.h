#pragma once
#include <cstdint>

// Elementary functions for loops that the compiler turns into wide code. They are made of additions, multiplications,
// divisions and bit operations only, each rounded as IEEE says: the same bits from every instruction set. Files of
// kernels are compiled with -O3 -fno-math-errno -fno-trapping-math (CMakeLists.txt).

// A kernel is compiled once for every width that the machine may have; the loader picks one.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define DRESSFORM_WIDE __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define DRESSFORM_WIDE
#endif
#define DRESSFORM_INLINE inline __attribute__((always_inline))

namespace dressform::wide {

DRESSFORM_INLINE float float_of_bits(std::uint32_t bits) { return __builtin_bit_cast(float, bits); }
DRESSFORM_INLINE std::uint32_t bits_of_float(float value) { return __builtin_bit_cast(std::uint32_t, value); }

DRESSFORM_INLINE float smaller(float a, float b) { return a < b ? a : b; }
DRESSFORM_INLINE float larger(float a, float b) { return a > b ? a : b; }
DRESSFORM_INLINE float absolute(float a) { return float_of_bits(bits_of_float(a) & 0x7fffffffu); }

// Nearest whole number, |x| < 2^22.
DRESSFORM_INLINE float nearest(float x) { return (x + 12582912.0f) - 12582912.0f; }

// sin and cos of 2 pi x; errors below 1e-6, |x| < 2^22.
DRESSFORM_INLINE void sincos_of_turns(float turns, float& sine, float& cosine) {
  const float half = 3.14159265358979f * (turns - nearest(turns));  // half the angle, within +-pi/2
  const float h = half * half;
  const float s =
      half *
      (1.0f + h * (-1.0f / 6 + h * (1.0f / 120 + h * (-1.0f / 5040 + h * (1.0f / 362880 + h * (-1.0f / 39916800))))));
  const float c =
      1.0f + h * (-0.5f + h * (1.0f / 24 + h * (-1.0f / 720 +
                                                h * (1.0f / 40320 + h * (-1.0f / 3628800 + h * (1.0f / 479001600))))));
  sine = 2.0f * s * c;
  cosine = 1.0f - 2.0f * s * s;
}

// The angle of (x, y) in turns, [0, 1); 0 for the null vector. Abramowitz and Stegun 4.4.49: errors below 1e-7.
DRESSFORM_INLINE float turns_of(float x, float y) {
  const float ax = absolute(x), ay = absolute(y);
  const float large = larger(ax, ay), small = smaller(ax, ay);
  const float t = small / larger(large, 1e-30f), h = t * t;
  float angle =
      t *
      (1.0f +
       h * (-0.3333314528f +
            h * (0.1999355085f +
                 h * (-0.1420889944f +
                      h * (0.1065626393f +
                           h * (-0.0752896400f + h * (0.0429096138f + h * (-0.0161657367f + h * 0.0028662257f))))))));
  angle *= 0.159154943f;
  angle = ay > ax ? 0.25f - angle : angle;
  angle = x < 0 ? 0.5f - angle : angle;
  angle = y < 0 ? 1.0f - angle : angle;
  return angle >= 1.0f ? 0.0f : angle;
}

// 2^x, |x| < 120; relative error below 3e-7.
DRESSFORM_INLINE float exp2(float x) {
  const float whole = nearest(x), f = 0.69314718056f * (x - whole);
  const float p =
      1.0f + f * (1.0f + f * (0.5f + f * (1.0f / 6 + f * (1.0f / 24 + f * (1.0f / 120 + f * (1.0f / 720))))));
  return p * float_of_bits(static_cast<std::uint32_t>(static_cast<std::int32_t>(whole) + 127) << 23);
}

// Natural logarithm of a positive normal number; relative error below 1e-6.
DRESSFORM_INLINE float log(float x) {
  const std::int32_t bits = static_cast<std::int32_t>(bits_of_float(x));
  const std::int32_t exponent = (bits - 0x3f3504f3) >> 23;  // the mantissa is then within sqrt(1/2) to sqrt(2)
  const float m = float_of_bits(static_cast<std::uint32_t>(bits - (exponent << 23)));
  const float s = (m - 1.0f) / (m + 1.0f), h = s * s;
  const float series = 2.0f * s * (1.0f + h * (1.0f / 3 + h * (1.0f / 5 + h * (1.0f / 7 + h * (1.0f / 9)))));
  return 0.69314718056f * static_cast<float>(exponent) + series;
}

// Angle whose cosine is c, 0 <= c <= 1, radians. Abramowitz and Stegun 4.4.45: errors below 7e-5.
DRESSFORM_INLINE float acos(float c) {
  return __builtin_sqrtf(1.0f - c) * (1.5707288f + c * (-0.2121144f + c * (0.0742610f - c * 0.0187293f)));
}

}  // namespace dressform::wide
