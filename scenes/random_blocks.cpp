#include <Random123/philox.h>

#include "scenes/random.h"
#include "scenes/wide_math.h"

namespace dressform {
namespace {

constexpr int lanes = 64;  // counters side by side
static_assert(4 * lanes == normal_block);

// (0, 1) from the upper 24 bits.
DRESSFORM_INLINE float unit(std::uint32_t bits) {
  return (static_cast<float>(static_cast<std::int32_t>(bits >> 8)) + 0.5f) * 0x1p-24f;
}

DRESSFORM_WIDE void random_bits(std::uint64_t seed, std::uint64_t stream, std::uint64_t first,
                                std::uint32_t (&bits)[4][lanes]) {
  // Philox 4x32-10 written out for many counters at once.
  std::uint32_t c0[lanes], c1[lanes], c2[lanes], c3[lanes];
  for (int i = 0; i < lanes; ++i) {
    const std::uint64_t index = first + static_cast<std::uint64_t>(i);
    c0[i] = static_cast<std::uint32_t>(index), c1[i] = static_cast<std::uint32_t>(index >> 32);
    c2[i] = static_cast<std::uint32_t>(stream), c3[i] = static_cast<std::uint32_t>(stream >> 32);
  }
  std::uint32_t k0 = static_cast<std::uint32_t>(seed), k1 = static_cast<std::uint32_t>(seed >> 32);
  for (int round = 0; round < 10; ++round) {
    for (int i = 0; i < lanes; ++i) {
      const std::uint64_t p0 = static_cast<std::uint64_t>(PHILOX_M4x32_0) * c0[i];
      const std::uint64_t p1 = static_cast<std::uint64_t>(PHILOX_M4x32_1) * c2[i];
      const std::uint32_t next0 = static_cast<std::uint32_t>(p1 >> 32) ^ c1[i] ^ k0;
      const std::uint32_t next2 = static_cast<std::uint32_t>(p0 >> 32) ^ c3[i] ^ k1;
      c1[i] = static_cast<std::uint32_t>(p1), c3[i] = static_cast<std::uint32_t>(p0);
      c0[i] = next0, c2[i] = next2;
    }
    k0 += PHILOX_W32_0, k1 += PHILOX_W32_1;
  }
  for (int i = 0; i < lanes; ++i) bits[0][i] = c0[i], bits[1][i] = c1[i], bits[2][i] = c2[i], bits[3][i] = c3[i];
}

DRESSFORM_WIDE void box_muller(const std::uint32_t (&bits)[4][lanes], float* out) {
  for (int pair = 0; pair < 2; ++pair) {
    const std::uint32_t* u = bits[2 * pair];
    const std::uint32_t* v = bits[2 * pair + 1];
    float* first = out + 2 * pair * lanes;
    float* second = first + lanes;
    for (int i = 0; i < lanes; ++i) {
      const float radius = __builtin_sqrtf(-2.0f * wide::log(unit(u[i])));
      float sine, cosine;
      wide::sincos_of_turns(unit(v[i]), sine, cosine);
      first[i] = radius * cosine;
      second[i] = radius * sine;
    }
  }
}

}  // namespace

void fill_normals(std::uint64_t seed, std::uint64_t stream, std::uint64_t first_block, int blocks, float* out) {
  std::uint32_t bits[4][lanes];
  for (int i = 0; i < blocks; ++i) {
    random_bits(seed, stream, (first_block + static_cast<std::uint64_t>(i)) * lanes, bits);
    box_muller(bits, out + static_cast<std::ptrdiff_t>(i) * normal_block);
  }
}

}  // namespace dressform
