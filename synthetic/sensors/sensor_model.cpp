#include "synthetic/sensors/sensor_model.h"

#include <algorithm>
#include <cmath>

namespace dressform {

float ir_counts(const IrSample& sample, float cos_axis) {
  constexpr float white_at_1m = 16 * 1300.0f;
  if (sample.depth_m <= 0) return 0;
  if (sample.chrome) return sample.mirror_cos > 0.985f ? 65535.0f : 300.0f;
  const float lens = cos_axis * cos_axis;  // emitter profile and what the lens leaves of cos^4
  return white_at_1m * sample.nir_albedo * sample.cos_incidence * lens / (sample.distance_m * sample.distance_m);
}

std::uint16_t depth_in_mm(double depth_m, double offset_m, double minimum_m, double maximum_m) {
  if (!(depth_m >= minimum_m && depth_m <= maximum_m)) return 0;
  const double measured_mm = std::round(1000 * (depth_m + offset_m));
  return static_cast<std::uint16_t>(std::clamp(measured_mm, 0.0, 65535.0));
}

}  // namespace dressform
