#include "pipeline/multipath/bounce_kernel.h"

#include "scenes/wide_math.h"

namespace dressform::bounce {
namespace {

constexpr float light_m_per_us = 299.792458f;
constexpr float turns80 = 80 / light_m_per_us, turns16 = 16 / light_m_per_us, turns120 = 120 / light_m_per_us;

DRESSFORM_WIDE void add(const Source& q, const float* __restrict x, const float* __restrict y,
                        const float* __restrict z, const float* __restrict nx, const float* __restrict ny,
                        const float* __restrict nz, const float* __restrict from_emitter_m, int n, float* __restrict c0,
                        float* __restrict c1, float* __restrict c2, float* __restrict s0, float* __restrict s1,
                        float* __restrict s2) {
  for (int i = 0; i < n; ++i) {
    const float dx = q.x - x[i], dy = q.y - y[i], dz = q.z - z[i];
    const float square = wide::larger(1e-6f, dx * dx + dy * dy + dz * dz);
    const float arrives = wide::larger(0.0f, nx[i] * dx + ny[i] * dy + nz[i] * dz);
    const float leaves = wide::larger(0.0f, -(q.normal_x * dx + q.normal_y * dy + q.normal_z * dz));
    const float light = q.light * arrives * leaves / (square * (square + 0.318309886f * q.area_m2));
    const float detour_m = q.from_emitter_m + __builtin_sqrtf(square) - from_emitter_m[i];
    float s, c;
    wide::sincos_of_turns(detour_m * turns80, s, c);
    c0[i] += light * c, s0[i] += light * s;
    wide::sincos_of_turns(detour_m * turns16, s, c);
    c1[i] += light * c, s1[i] += light * s;
    wide::sincos_of_turns(detour_m * turns120, s, c);
    c2[i] += light * c, s2[i] += light * s;
  }
}

}  // namespace

void add_source(const Source& source, const Receivers& to, float* const (&cosine)[frequencies],
                float* const (&sine)[frequencies]) {
  add(source, to.x, to.y, to.z, to.normal_x, to.normal_y, to.normal_z, to.from_emitter_m, to.count, cosine[0],
      cosine[1], cosine[2], sine[0], sine[1], sine[2]);
}

}  // namespace dressform::bounce
