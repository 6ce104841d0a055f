#include "synthetic/sensors/tof_decode.h"

#include "scenes/wide_math.h"

namespace dressform::tof {
namespace {

constexpr float least_amplitude = 3, least_amplitude_sum = 10;
constexpr float corner = 0.1070f, side = 0.1131f, centre = 0.1196f;
constexpr float weight_exponent = -1.442695f * 5 * 1.44269504f;  // of 2, per unit of angular difference

struct Sums {
  float weight = 0, a = 0, b = 0, delta = 0;
};

DRESSFORM_INLINE void add(float gaussian, float ux, float uy, float ox, float oy, float amplitude, Sums& sums) {
  const float delta = 0.5f * (1.0f - (ux * ox + uy * oy));
  const bool counts = amplitude >= least_amplitude;
  const float weight = counts ? gaussian * wide::exp2(weight_exponent * delta) : 0.0f;
  sums.weight += weight;
  sums.a += weight * amplitude * ox;
  sums.b += weight * amplitude * oy;
  sums.delta += counts ? delta : 0.0f;
}

DRESSFORM_WIDE void bilateral_of(const float* __restrict x0, const float* __restrict y0, const float* __restrict a0,
                                 const float* __restrict x1, const float* __restrict y1, const float* __restrict a1,
                                 const float* __restrict x2, const float* __restrict y2, const float* __restrict a2,
                                 int n, float* __restrict out_a, float* __restrict out_b,
                                 float* __restrict worst_delta) {
  for (int i = 1; i < n - 1; ++i) {
    const float ux = x1[i], uy = y1[i];
    Sums sums;
    add(corner, ux, uy, x0[i - 1], y0[i - 1], a0[i - 1], sums);
    add(side, ux, uy, x0[i], y0[i], a0[i], sums);
    add(corner, ux, uy, x0[i + 1], y0[i + 1], a0[i + 1], sums);
    add(side, ux, uy, x1[i - 1], y1[i - 1], a1[i - 1], sums);
    add(centre, ux, uy, ux, uy, a1[i], sums);
    add(side, ux, uy, x1[i + 1], y1[i + 1], a1[i + 1], sums);
    add(corner, ux, uy, x2[i - 1], y2[i - 1], a2[i - 1], sums);
    add(side, ux, uy, x2[i], y2[i], a2[i], sums);
    add(corner, ux, uy, x2[i + 1], y2[i + 1], a2[i + 1], sums);
    const float scale = sums.weight > 0 ? 1.0f / sums.weight : 0.0f;
    out_a[i] = scale * sums.a;
    out_b[i] = scale * sums.b;
    worst_delta[i] = wide::larger(worst_delta[i], sums.delta);
  }
}

// Depth along the axis from the whole path: |p - emitter| + |p| = path, with the emitter at (45 mm, 0, 0). The driver
// leaves out the constant term, half a millimetre at 1 m.
DRESSFORM_INLINE float depth_of_path(float path, float x, float y) {
  const float along = path / (2.0f * __builtin_sqrtf(x * x + y * y + 1.0f));
  const float square = path * path;
  return along * (1.0f - emitter_x_mm * emitter_x_mm / square) / (1.0f - 2.0f * emitter_x_mm * x * along / square);
}

DRESSFORM_WIDE void unwrap_row(const float* __restrict a0, const float* __restrict b0, const float* __restrict a1,
                               const float* __restrict b1, const float* __restrict a2, const float* __restrict b2,
                               const float* __restrict own_amplitude, const float* __restrict ideal_x,
                               const float* __restrict ideal_y, int n, float* __restrict depth_mm,
                               float* __restrict amplitude_sum) {
  constexpr float turn = 6.28318531f;
  for (int i = 0; i < n; ++i) {
    const float m0 = __builtin_sqrtf(a0[i] * a0[i] + b0[i] * b0[i]);
    const float m1 = __builtin_sqrtf(a1[i] * a1[i] + b1[i] * b1[i]);
    const float m2 = __builtin_sqrtf(a2[i] * a2[i] + b2[i] * b2[i]);
    const float least = wide::smaller(m0, wide::smaller(m1, m2)), sum = m0 + m1 + m2;
    // In units of a common period: 3, 15 and 2 of them are one turn of each frequency.
    const float t0 = 3.0f * wide::turns_of(a0[i], b0[i]);
    float t1 = 15.0f * wide::turns_of(a1[i], b1[i]);
    const float t2 = 2.0f * wide::turns_of(a2[i], b2[i]);
    float t5 = 3.0f * wide::nearest((t1 - t0) * (1.0f / 3)) + t0;
    const float half = wide::absolute(t5 - t2) * 0.5f;
    const float odd = 2.0f * (half - (wide::nearest(half - 0.5f)));  // |t5 - t2| modulo 2
    const bool second_turn = (odd > 0.5f) & (odd < 1.5f);
    t5 = second_turn ? t5 + 15.0f : t5;
    t1 = second_turn ? t1 + 15.0f : t1;
    const float n2 = wide::nearest((t5 - t2) * 0.5f) + 0.5f * t2;
    const float n0 = t5 * (1.0f / 3), n1 = t1 * (1.0f / 15);
    const float t = (n0 + n1 + n2) * (1.0f / 3);
    const float c0 = turn * (n1 * 0.826977f - n2 * 0.110264f), c1 = turn * (n2 * 0.551318f - n0 * 0.826977f),
                c2 = turn * (n0 * 0.110264f - n1 * 0.551318f);
    const float safe_least = wide::larger(least, 1e-3f);
    const float bound = wide::exp2(1.44269504f * 3.321928f * (0.7694894f - 0.1604664f * wide::log(safe_least)));
    const float q = wide::smaller(0.6108653f, wide::larger(0.3490659f, bound));
    // A path shorter than the way to the emitter's window and back is noise about zero.
    const bool good = (least >= least_amplitude) & (sum >= least_amplitude_sum) & (own_amplitude[i] >= 0) &
                      (c0 * c0 + c1 * c1 + c2 * c2 <= q * q) & (t > 0.03f);
    const float z = depth_of_path(4166.667f * wide::larger(t, 0.03f), ideal_x[i], ideal_y[i]);
    depth_mm[i] = good ? z : 0.0f;
    amplitude_sum[i] = sum;
  }
}

struct Spread {
  float least = 1e9f, most = 0, sum = 0, squares = 0;
};

DRESSFORM_INLINE void add(float depth, float amplitude, Spread& spread) {
  spread.least = depth > 0 ? wide::smaller(spread.least, depth) : spread.least;
  spread.most = wide::larger(spread.most, depth);
  spread.sum += amplitude;
  spread.squares += amplitude * amplitude;
}

DRESSFORM_WIDE void edge_filter_row(const float* __restrict d0, const float* __restrict d1, const float* __restrict d2,
                                    const float* __restrict s0, const float* __restrict s1, const float* __restrict s2,
                                    int n, float* __restrict out) {
  for (int i = 1; i < n - 1; ++i) {
    Spread spread;
    add(d0[i - 1], s0[i - 1], spread), add(d0[i], s0[i], spread), add(d0[i + 1], s0[i + 1], spread);
    add(d1[i - 1], s1[i - 1], spread), add(d1[i], s1[i], spread), add(d1[i + 1], s1[i + 1], spread);
    add(d2[i - 1], s2[i - 1], spread), add(d2[i], s2[i], spread), add(d2[i + 1], s2[i + 1], spread);
    const float mean = spread.sum * (1.0f / 9);
    const float deviation =
        __builtin_sqrtf(wide::larger(0.0f, 9.0f * spread.squares - spread.sum * spread.sum)) * (1.0f / 9);
    const float below = wide::absolute(d1[i] - spread.least), above = wide::absolute(d1[i] - spread.most);
    const bool edge = deviation >= 0.05f * wide::larger(mean, 50.0f) && below > 50.0f && above > 30.0f &&
                      wide::larger(below, above) > 100.0f;
    out[i] = edge ? 0.0f : d1[i];
  }
}

}  // namespace

void copy_unfiltered(const PhasorRows& rows, int n, const FilteredRow& out) {
  for (int f = 0; f < frequencies; ++f)
    for (int i = 0; i < n; ++i) {
      out.a[f][i] = rows.centre.amplitude[f][i] * rows.centre.cosine[f][i];
      out.b[f][i] = rows.centre.amplitude[f][i] * rows.centre.sine[f][i];
    }
  for (int i = 0; i < n; ++i) out.worst_delta[i] = 0;
}

void bilateral(const PhasorRows& rows, int n, const FilteredRow& out) {
  copy_unfiltered(rows, n, out);
  for (int f = 0; f < frequencies; ++f)
    bilateral_of(rows.above.cosine[f], rows.above.sine[f], rows.above.amplitude[f], rows.centre.cosine[f],
                 rows.centre.sine[f], rows.centre.amplitude[f], rows.below.cosine[f], rows.below.sine[f],
                 rows.below.amplitude[f], n, out.a[f], out.b[f], out.worst_delta);
}

void unwrap(const FilteredRow& filtered, const PhasorRows& rows, const float* ideal_x, const float* ideal_y, int n,
            float* depth_mm, float* amplitude_sum) {
  unwrap_row(filtered.a[0], filtered.b[0], filtered.a[1], filtered.b[1], filtered.a[2], filtered.b[2],
             rows.centre.amplitude[0], ideal_x, ideal_y, n, depth_mm, amplitude_sum);
}

void edge_filter(const DecodedRows& rows, int n, float* depth_mm) {
  depth_mm[0] = rows.depth_mm[1][0];
  depth_mm[n - 1] = rows.depth_mm[1][n - 1];
  edge_filter_row(rows.depth_mm[0], rows.depth_mm[1], rows.depth_mm[2], rows.amplitude_sum[0], rows.amplitude_sum[1],
                  rows.amplitude_sum[2], n, depth_mm);
}

}  // namespace dressform::tof
