#pragma once

namespace dressform::bounce {

constexpr int frequencies = 3;

// The surface element that sends light on: place and normal in metres, way from the emitter, light it sends.
struct Source {
  float x, y, z, normal_x, normal_y, normal_z, from_emitter_m;
  float light;    // albedo / pi x what the emitter sends into the element
  float area_m2;  // softens the inverse square nearby
};

// Points that receive it, one array each; metres.
struct Receivers {
  const float *x, *y, *z, *normal_x, *normal_y, *normal_z, *from_emitter_m;
  int count;
};

// Adds the light of one source, as a phasor at each of the Kinect v2's frequencies (80, 16, 120 MHz) relative to the
// receiver's own direct path.
void add_source(const Source& source, const Receivers& receivers, float* const (&cosine)[frequencies],
                float* const (&sine)[frequencies]);

}  // namespace dressform::bounce
