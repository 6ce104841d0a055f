#include "synthetic/sensors/tof_samples.h"

#include "scenes/wide_math.h"

namespace dressform::tof {
namespace {

constexpr float cos_phase[3] = {1.0f, -0.5f, -0.5f};
constexpr float sin_phase[3] = {0.0f, 0.866025404f, -0.866025404f};
constexpr float grazing_end = 1.4f;  // rad: the law of the relief ends where the footprint is longer than it is true

// The value as 11 bits keep it: y_0 = 0, y_{x+1} = y_x + 2^max(0, floor(x / 128) - 1), mirrored.
DRESSFORM_INLINE float companded(float value) {
  const std::uint32_t octave = wide::bits_of_float(value) & 0x7f800000u;
  const float step = wide::larger(1.0f, wide::float_of_bits(octave) * (1.0f / 128));
  return wide::nearest(value / step) * step;
}

DRESSFORM_WIDE void add_noise(const float* sample, const float* light, const float* normals,
                              const Electronics& electronics, int n, float* out) {
  const float read = electronics.read_variance, shot = electronics.shot, ambient = electronics.ambient;
  const float relative = electronics.relative * electronics.relative, scale = electronics.noise_scale;
  const bool coarse = electronics.companding;
  for (int i = 0; i < n; ++i) {
    const float variance = read + shot * (light[i] + ambient) + relative * light[i] * light[i];
    const float value = sample[i] + scale * __builtin_sqrtf(variance) * normals[i];
    const float stored = coarse ? companded(value) : value;
    out[i] = wide::smaller(full_scale, wide::larger(-full_scale, stored));
  }
}

DRESSFORM_WIDE void demodulate(const float* __restrict m0, const float* __restrict m1, const float* __restrict m2,
                               float contrast_of, int n, float* __restrict x, float* __restrict y,
                               float* __restrict amplitude, float* __restrict saturated) {
  const float scale = 1.0f / contrast_of;
  for (int i = 0; i < n; ++i) {
    const float a = scale * (m0[i] - 0.5f * (m1[i] + m2[i]));
    const float b = scale * sin_phase[1] * (m2[i] - m1[i]);
    const float length = __builtin_sqrtf(a * a + b * b);
    const float unit = length > 1e-6f ? 1.0f / length : 0.0f;
    x[i] = a * unit, y[i] = b * unit, amplitude[i] = (2.0f / 3) * length;
    const float top = wide::larger(wide::absolute(m0[i]), wide::larger(wide::absolute(m1[i]), wide::absolute(m2[i])));
    saturated[i] = wide::larger(saturated[i], top);
  }
}

DRESSFORM_WIDE void drop_saturated(const float* __restrict saturated, int n, float* __restrict x, float* __restrict y,
                                   float* __restrict amplitude) {
  for (int i = 0; i < n; ++i) {
    const bool over = saturated[i] >= full_scale;
    x[i] = over ? 0.0f : x[i], y[i] = over ? 0.0f : y[i], amplitude[i] = over ? -1.0f : amplitude[i];
  }
}

// Three samples of an unclipped frequency.
DRESSFORM_WIDE void expose_sine(const Points& points, int f, const float* interference, int n, float* __restrict m0,
                                float* __restrict m1, float* __restrict m2) {
  const float* __restrict bounce_cos = points.bounce[2 * f];
  const float* __restrict bounce_sin = points.bounce[2 * f + 1];
  const float* __restrict path_mm = points.path_mm;
  const float* __restrict direct = points.direct;
  const float* __restrict gain = points.gain;
  const float turns_per_mm = 1.0f / wavelength_mm[f], c = contrast[f];
  const float i0 = interference[0], i1 = interference[1], i2 = interference[2];
  for (int i = 0; i < n; ++i) {
    float s, u;
    wide::sincos_of_turns(path_mm[i] * turns_per_mm, s, u);
    const float re_part = direct[i] + gain[i] * bounce_cos[i], im_part = gain[i] * bounce_sin[i];
    const float re = u * re_part - s * im_part, im = s * re_part + u * im_part, own = direct[i];
    m0[i] = c * (re + own * i0);
    m1[i] = c * (cos_phase[1] * re - sin_phase[1] * im + own * i1);
    m2[i] = c * (cos_phase[2] * re - sin_phase[2] * im + own * i2);
  }
}

// The direct light's correlation is cut at +-clip; what has bounced is weak and stays a sine.
DRESSFORM_WIDE void expose_clipped(const Points& points, int f, const float* interference, float clip, int n,
                                   float* __restrict m0, float* __restrict m1, float* __restrict m2) {
  const float* __restrict bounce_cos = points.bounce[2 * f];
  const float* __restrict bounce_sin = points.bounce[2 * f + 1];
  const float* __restrict path_mm = points.path_mm;
  const float* __restrict direct = points.direct;
  const float* __restrict gain = points.gain;
  const float turns_per_mm = 1.0f / wavelength_mm[f], c = contrast[f];
  const float i0 = interference[0], i1 = interference[1], i2 = interference[2];
  for (int i = 0; i < n; ++i) {
    float s, u;
    wide::sincos_of_turns(path_mm[i] * turns_per_mm, s, u);
    const float more_cos = gain[i] * bounce_cos[i], more_sin = gain[i] * bounce_sin[i];
    const float re = u * more_cos - s * more_sin, im = s * more_cos + u * more_sin, own = direct[i];
    const float g0 = u, g1 = cos_phase[1] * u - sin_phase[1] * s, g2 = cos_phase[2] * u - sin_phase[2] * s;
    m0[i] = c * (re + own * (wide::smaller(clip, wide::larger(-clip, g0)) + i0));
    m1[i] = c * (cos_phase[1] * re - sin_phase[1] * im + own * (wide::smaller(clip, wide::larger(-clip, g1)) + i1));
    m2[i] = c * (cos_phase[2] * re - sin_phase[2] * im + own * (wide::smaller(clip, wide::larger(-clip, g2)) + i2));
  }
}

DRESSFORM_WIDE void illuminate_lanes(const float* __restrict ideal_x, const float* __restrict ideal_y,
                                     const float* __restrict depth_m, const float* __restrict normal_x,
                                     const float* __restrict normal_y, const float* __restrict normal_z,
                                     const float* __restrict nir_albedo, const int* __restrict is_chrome, float signal,
                                     float profile_exponent, float chrome_albedo, float relief,
                                     float* __restrict path_mm, float* __restrict direct, float* __restrict gain,
                                     float* __restrict relief_mm) {
  for (int i = 0; i < packet_size; ++i) {
    const float x = ideal_x[i], y = ideal_y[i], z = depth_m[i];
    const float stretch = __builtin_sqrtf(1.0f + x * x + y * y), range = z * stretch;
    const float ex = z * x - 0.001f * emitter_x_mm, ey = z * y;  // from the emitter
    const float distance = wide::larger(1e-3f, __builtin_sqrtf(ex * ex + ey * ey + z * z));
    const float nx = normal_x[i], ny = normal_y[i], nz = normal_z[i];
    const float lit = wide::larger(0.0f, -(nx * ex + ny * ey + nz * z) / distance);
    const float seen = wide::smaller(1.0f, wide::larger(0.0f, -(nx * x + ny * y + nz) / stretch));
    const float lens = 1.0f / (stretch * stretch * stretch * stretch);
    const float profile = wide::exp2(profile_exponent * wide::log(stretch));
    // Chrome lights up where it mirrors the emitter, far beyond full scale.
    const float chrome = is_chrome[i] ? 1.0f : 0.0f, glint = seen > 0.9962f ? chrome : 0.0f;
    const float matt = is_chrome[i] ? chrome_albedo : nir_albedo[i];
    const float theta = wide::smaller(grazing_end, wide::acos(seen)), rest = 1.57079633f - theta;
    const float strength = z > 0 ? signal * lens : 0.0f;
    path_mm[i] = 1000.0f * (range + distance);
    gain[i] = strength * matt * (1.0f - glint);
    direct[i] = strength * (matt + 100.0f * glint) * profile * lit / (distance * distance);
    relief_mm[i] = 6.0f * stretch * relief * z * __builtin_sqrtf(z) * (theta * theta) / (rest * rest);
  }
}

}  // namespace

void illuminate(const IrPacket& packet, const Lamp& lamp, Returned& out) {
  illuminate_lanes(packet.ideal_x, packet.ideal_y, packet.depth_m, packet.normal_x, packet.normal_y, packet.normal_z,
                   packet.nir_albedo, packet.chrome, lamp.signal_at_1m, 1.44269504f * (4.0f - lamp.falloff),
                   lamp.chrome_albedo, lamp.relief, out.path_mm, out.direct, out.gain, out.relief_mm);
}

void expose(const Points& points, const FrameErrors& errors, int n, float* const (&samples)[raw_samples],
            float* light) {
  for (int f = 0; f < frequencies; ++f) {
    float *m0 = samples[3 * f], *m1 = samples[3 * f + 1], *m2 = samples[3 * f + 2];
    const float* interference = errors.interference + 3 * f;
    if (f == 1 && errors.clip < 1)
      expose_clipped(points, f, interference, errors.clip, n, m0, m1, m2);
    else
      expose_sine(points, f, interference, n, m0, m1, m2);
  }
  for (int i = 0; i < n; ++i) light[i] = points.direct[i] + points.gain[i] * points.bounce[bounce_terms - 1][i];
}

void read_out(const float* const (&samples)[raw_samples], const float* light, const float* normals,
              const Electronics& electronics, int n, const PhasorRow& out) {
  constexpr int most = 256;  // points at a time
  float stored[3][most], saturated[most];
  for (int first = 0; first < n; first += most) {
    const int count = n - first < most ? n - first : most;
    for (int i = 0; i < count; ++i) saturated[i] = 0;
    for (int f = 0; f < frequencies; ++f) {
      for (int k = 0; k < 3; ++k) {
        const int s = 3 * f + k;
        add_noise(samples[s] + first, light + first, normals + static_cast<long>(s) * n + first, electronics, count,
                  stored[k]);
      }
      demodulate(stored[0], stored[1], stored[2], contrast[f], count, out.cosine[f] + first, out.sine[f] + first,
                 out.amplitude[f] + first, saturated);
    }
    for (int f = 0; f < frequencies; ++f)
      drop_saturated(saturated, count, out.cosine[f] + first, out.sine[f] + first, out.amplitude[f] + first);
  }
}

}  // namespace dressform::tof
