#pragma once
#include "synthetic/sensors/tof_samples.h"

// The decoding half of a Kinect v2, as the open driver does it (libfreenect2, "depth packet processor"): joint
// bilateral filter, amplitude thresholds, unwrapping by three frequencies, confidence, depth, edge filter.
namespace dressform::tof {

// Three neighbouring rows of phasors; the middle one is decoded.
struct PhasorRows {
  struct Row {
    const float *cosine[frequencies], *sine[frequencies], *amplitude[frequencies];
  };
  Row above, centre, below;
};

// Filtered a = amplitude cos, b = amplitude sin per frequency, in counts; worst_delta: the largest sum of angular
// differences to the neighbours among the frequencies. The first and the last point are copied.
struct FilteredRow {
  float *a[frequencies], *b[frequencies], *worst_delta;
};
void bilateral(const PhasorRows& rows, int n, const FilteredRow& out);

// The centre row as it is.
void copy_unfiltered(const PhasorRows& rows, int n, const FilteredRow& out);

// Depth along the optical axis, millimetres, 0 where the thresholds or the confidence reject it; and the sum of the
// three amplitudes. `ideal_x/y`: x/z and y/z of the rays.
void unwrap(const FilteredRow& filtered, const PhasorRows& rows, const float* ideal_x, const float* ideal_y, int n,
            float* depth_mm, float* amplitude_sum);

constexpr float worst_delta_allowed = 2.5f;

struct DecodedRows {
  const float* depth_mm[3];  // above, centre, below
  const float* amplitude_sum[3];
};
// The centre row's depth, 0 where it lies between the depths of its neighbours at an edge of the infrared image. The
// first and the last point are copied.
void edge_filter(const DecodedRows& rows, int n, float* depth_mm);

}  // namespace dressform::tof
