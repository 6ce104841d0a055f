#include "synthetic/sensors/tof_bounce.h"

#include "scenes/wide_math.h"

namespace dressform::tof {
namespace {

struct Patch {
  float x, y, z, nx, ny, nz, from_emitter_m, weight, area_m2;
};

DRESSFORM_WIDE void add_patch(const Patch& q, const float* __restrict x, const float* __restrict y,
                              const float* __restrict z, const float* __restrict nx, const float* __restrict ny,
                              const float* __restrict nz, const float* __restrict from_emitter_m, int n,
                              float* __restrict c0, float* __restrict s0, float* __restrict c1, float* __restrict s1,
                              float* __restrict c2, float* __restrict s2, float* __restrict plain) {
  for (int i = 0; i < n; ++i) {
    const float dx = q.x - x[i], dy = q.y - y[i], dz = q.z - z[i];
    const float square = dx * dx + dy * dy + dz * dz, distance = __builtin_sqrtf(square);
    const float arrives = wide::larger(0.0f, nx[i] * dx + ny[i] * dy + nz[i] * dz);
    const float leaves = wide::larger(0.0f, -(q.nx * dx + q.ny * dy + q.nz * dz));
    // cos cos / d^2, softened near the patch as for a disk of its area.
    const float safe = wide::larger(square, 1e-6f);
    const float light = q.weight * arrives * leaves / (safe * (safe + 0.318309886f * q.area_m2));
    const float extra_mm = 1000.0f * (q.from_emitter_m + distance - from_emitter_m[i]);
    float s, c;
    wide::sincos_of_turns(extra_mm * (1.0f / wavelength_mm[0]), s, c);
    c0[i] += light * c, s0[i] += light * s;
    wide::sincos_of_turns(extra_mm * (1.0f / wavelength_mm[1]), s, c);
    c1[i] += light * c, s1[i] += light * s;
    wide::sincos_of_turns(extra_mm * (1.0f / wavelength_mm[2]), s, c);
    c2[i] += light * c, s2[i] += light * s;
    plain[i] += light;
  }
}

}  // namespace

void SurfacePoints::resize(std::size_t count) {
  for (auto* each : {&x, &y, &z, &normal_x, &normal_y, &normal_z, &from_emitter_m}) each->assign(count, 0.0f);
}

void gather_bounce(const LitPatches& patches, const SurfacePoints& points, int first, int n,
                   float* const (&terms)[bounce_terms]) {
  for (float* term : terms)
    for (int i = 0; i < n; ++i) term[i] = 0;
  const SurfacePoints& q = patches.points;
  for (std::size_t j = 0; j < patches.weight.size(); ++j) {
    if (patches.weight[j] <= 0) continue;
    const Patch patch{q.x[j],
                      q.y[j],
                      q.z[j],
                      q.normal_x[j],
                      q.normal_y[j],
                      q.normal_z[j],
                      q.from_emitter_m[j],
                      patches.weight[j],
                      patches.area_m2[j]};
    add_patch(patch, &points.x[first], &points.y[first], &points.z[first], &points.normal_x[first],
              &points.normal_y[first], &points.normal_z[first], &points.from_emitter_m[first], n, terms[0], terms[1],
              terms[2], terms[3], terms[4], terms[5], terms[6]);
  }
}

}  // namespace dressform::tof
