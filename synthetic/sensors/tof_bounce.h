#pragma once
#include <vector>

#include "synthetic/sensors/tof_samples.h"

namespace dressform::tof {

// Points with normals in the camera frame, metres; one array each.
struct SurfacePoints {
  std::vector<float> x, y, z, normal_x, normal_y, normal_z, from_emitter_m;
  void resize(std::size_t count);
};

// Patches of what the emitter lights, each sending its light on evenly to all sides.
struct LitPatches {
  SurfacePoints points;
  std::vector<float> weight;   // albedo / pi x emitter profile x solid angle seen from the lens
  std::vector<float> area_m2;  // softens the inverse square near the patch
};

// Light that reaches `n` points, from point `first` on, by way of the patches: amplitudes and phases relative to the
// direct path (terms of `Points::bounce`). One bounce, without a look at what stands between.
void gather_bounce(const LitPatches& patches, const SurfacePoints& points, int first, int n,
                   float* const (&terms)[bounce_terms]);

}  // namespace dressform::tof
