#include "pipeline/body/section_depth.h"

#include <algorithm>
#include <limits>

namespace dressform {

double section_depth(const SectionLoop& loop, const BodyLimbs& limbs, double offset) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0, j = loop.points.size() - 1; i < loop.points.size(); j = i++) {
    const Vector3d a = loop.points[j] - loop.centroid, b = loop.points[i] - loop.centroid;
    const double x = a.dot(limbs.left) - offset, y = b.dot(limbs.left) - offset;
    if ((x < 0) == (y < 0)) continue;
    const double at = (a + x / (x - y) * (b - a)).dot(limbs.front);
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return std::max(0.0, high - low);
}

bool thighs_that_touch(const SectionLoop& loop, const BodyLimbs& limbs, double stature) {
  if (loop.points.size() < 8) return false;
  const double side = 0.055 * stature;  // about the middle of a thigh
  return section_depth(loop, limbs, 0) <
         0.45 * std::min(section_depth(loop, limbs, side), section_depth(loop, limbs, -side));
}

}  // namespace dressform
