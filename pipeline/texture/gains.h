#pragma once
#include <map>
#include <string>
#include <vector>

#include "pipeline/texture/vertex_samples.h"

namespace dressform {

struct GainParams {
  double least_facing = 0.35;  // vertices seen more obliquely do not count
  int least_vertices = 30;     // a pair of views needs so many in common
};

// Overlaps of views, collected over garments: log of the ratio of linear light, per pair of sensors and channel (BGR).
class Overlaps {
 public:
  void add(const std::vector<ColorView>& views, const VertexSamples& samples, const GainParams& params);
  // Linear gain per sensor and channel that makes the views agree: least squares on the pairs' medians, mean log gain
  // zero. A sensor with no overlap keeps 1.
  std::map<std::string, cv::Vec3f> gains(const GainParams& params) const;

 private:
  using Pair = std::pair<std::string, std::string>;
  std::map<Pair, std::array<std::vector<float>, 3>> log_ratios_;
};

// Whether a level (0-255, sRGB) says much of a ratio of light: neither near black nor clipped.
bool is_usable_level(float level);

// Linear light (0-1) of a level (0-255, sRGB).
float linear_of_level(float level);

// The level (0-255, sRGB) of `level` times a gain in linear light; not clipped.
float with_gain(float level, float gain);

// The view with the gain applied to both bands.
void apply_gain(ColorView& view, const cv::Vec3f& gain);

}  // namespace dressform
