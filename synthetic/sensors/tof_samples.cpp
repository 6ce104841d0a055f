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

DRESSFORM_WIDE void demodulate(const float* m0, const float* m1, const float* m2, float contrast_of, int n, float* x,
                               float* y, float* amplitude, float* saturated) {
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

DRESSFORM_WIDE void drop_saturated(const float* saturated, int n, float* x, float* y, float* amplitude) {
  for (int i = 0; i < n; ++i) {
    const bool over = saturated[i] >= full_scale;
    x[i] = over ? 0.0f : x[i], y[i] = over ? 0.0f : y[i], amplitude[i] = over ? -1.0f : amplitude[i];
  }
}

// Three samples of an unclipped frequency.
DRESSFORM_WIDE void expose_sine(const Points& points, int f, const float* interference, int n, float* m0, float* m1,
                                float* m2) {
  const float* bounce_cos = points.bounce[2 * f];
  const float* bounce_sin = points.bounce[2 * f + 1];
  const float turns_per_mm = 1.0f / wavelength_mm[f], c = contrast[f];
  for (int i = 0; i < n; ++i) {
    float s, u;
    wide::sincos_of_turns(points.path_mm[i] * turns_per_mm, s, u);
    const float re_part = points.direct[i] + points.gain[i] * bounce_cos[i], im_part = points.gain[i] * bounce_sin[i];
    const float re = u * re_part - s * im_part, im = s * re_part + u * im_part, own = points.direct[i];
    m0[i] = c * (re + own * interference[0]);
    m1[i] = c * (cos_phase[1] * re - sin_phase[1] * im + own * interference[1]);
    m2[i] = c * (cos_phase[2] * re - sin_phase[2] * im + own * interference[2]);
  }
}

// The direct light's correlation is cut at +-clip; what has bounced is weak and stays a sine.
DRESSFORM_WIDE void expose_clipped(const Points& points, int f, const float* interference, float clip, int n, float* m0,
                                   float* m1, float* m2) {
  const float* bounce_cos = points.bounce[2 * f];
  const float* bounce_sin = points.bounce[2 * f + 1];
  const float turns_per_mm = 1.0f / wavelength_mm[f], c = contrast[f];
  for (int i = 0; i < n; ++i) {
    float s, u;
    wide::sincos_of_turns(points.path_mm[i] * turns_per_mm, s, u);
    const float more_cos = points.gain[i] * bounce_cos[i], more_sin = points.gain[i] * bounce_sin[i];
    const float re = u * more_cos - s * more_sin, im = s * more_cos + u * more_sin, own = points.direct[i];
    const float g0 = u, g1 = cos_phase[1] * u - sin_phase[1] * s, g2 = cos_phase[2] * u - sin_phase[2] * s;
    m0[i] = c * (re + own * (wide::smaller(clip, wide::larger(-clip, g0)) + interference[0]));
    m1[i] = c * (cos_phase[1] * re - sin_phase[1] * im +
                 own * (wide::smaller(clip, wide::larger(-clip, g1)) + interference[1]));
    m2[i] = c * (cos_phase[2] * re - sin_phase[2] * im +
                 own * (wide::smaller(clip, wide::larger(-clip, g2)) + interference[2]));
  }
}

}  // namespace

DRESSFORM_WIDE void illuminate(const IrPacket& packet, const Lamp& lamp, Returned& out) {
  for (int i = 0; i < packet_size; ++i) {
    const float x = packet.ideal_x[i], y = packet.ideal_y[i], z = packet.depth_m[i];
    const float stretch = __builtin_sqrtf(1.0f + x * x + y * y), range = z * stretch;
    const float ex = z * x - 0.001f * emitter_x_mm, ey = z * y;  // from the emitter
    const float distance = __builtin_sqrtf(ex * ex + ey * ey + z * z);
    const float safe = distance > 1e-3f ? distance : 1.0f;
    const float nx = packet.normal_x[i], ny = packet.normal_y[i], nz = packet.normal_z[i];
    const float lit = wide::larger(0.0f, -(nx * ex + ny * ey + nz * z) / safe);
    const float seen = wide::smaller(1.0f, wide::larger(0.0f, -(nx * x + ny * y + nz) / stretch));
    const float log_cosine = -wide::log(stretch);
    const float lens = 1.0f / (stretch * stretch * stretch * stretch);
    const float profile = wide::exp2(1.44269504f * (lamp.falloff - 4.0f) * log_cosine);
    // Chrome lights up where it mirrors the emitter, far beyond full scale.
    const bool chrome = packet.chrome[i] != 0, glint = chrome && seen > 0.9962f;
    const float albedo = glint ? 100.0f : chrome ? lamp.chrome_albedo : packet.nir_albedo[i];
    const float theta = wide::smaller(grazing_end, wide::acos(seen)), rest = 1.57079633f - theta;
    const float gain = z > 0 ? lamp.signal_at_1m * albedo * lens : 0.0f;
    out.path_mm[i] = 1000.0f * (range + distance);
    out.gain[i] = glint ? 0.0f : gain;
    out.direct[i] = gain * profile * lit / (safe * safe);
    out.relief_mm[i] = 6.0f * stretch * lamp.relief * z * __builtin_sqrtf(z) * (theta * theta) / (rest * rest);
  }
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
