#pragma once
#include <array>
#include <cstdint>

namespace dressform {

// Counter-based random numbers (Philox 4x32-10; Salmon et al., SC 2011, through Random123). A value depends only on
// (seed, stream, index), so the order of evaluation and the number of threads do not matter.

// Four independent uniform numbers in (0, 1).
std::array<double, 4> uniform4(std::uint64_t seed, std::uint64_t stream, std::uint64_t index);

// Four independent standard normal numbers (Box-Muller).
std::array<double, 4> normal4(std::uint64_t seed, std::uint64_t stream, std::uint64_t index);

inline double uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
  return uniform4(seed, stream, index)[0];
}
inline double normal(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
  return normal4(seed, stream, index)[0];
}

// Standard normal numbers in bulk, float, for noise on whole images: `blocks` blocks of `normal_block`, from the
// block numbered `first_block` on. The numbers of normal4 at the indices of a block (a quarter as many as its numbers),
// in another order, from 24 bits each.
constexpr int normal_block = 256;
void fill_normals(std::uint64_t seed, std::uint64_t stream, std::uint64_t first_block, int blocks, float* out);

// A stream number from a name, stable across machines (FNV-1a).
constexpr std::uint64_t stream_of(const char* name) {
  std::uint64_t hash = 14695981039346656037ull;
  for (; *name; ++name) hash = (hash ^ static_cast<unsigned char>(*name)) * 1099511628211ull;
  return hash;
}

}  // namespace dressform
