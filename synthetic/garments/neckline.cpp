#include "synthetic/garments/neckline.h"

#include <algorithm>
#include <cmath>

namespace dressform {

Level neckline(const GarmentSpec& spec, const BodyLandmarks& landmarks) {
  const double size = landmarks.stature / 1.75, middle_y = landmarks.neck + 0.020, half_width = 0.104 * size;
  const double front_depth = spec.neck_depth_m * size, back_depth = 0.034 * size;
  const double point = spec.neck == "v" ? 0.85 : 0;  // 1: straight sides down to a sharp point
  return [=](const Vector3d& p) {
    const double forward = std::clamp((p.z() + 0.105) / 0.075, 0.0, 1.0);
    const double t = forward * forward * (3 - 2 * forward);
    const double depth = back_depth + t * (front_depth - back_depth);
    const double x = std::abs(p.x()) / half_width, y = std::max(middle_y - p.y(), 0.0) / depth;
    const double power = 2 - point * t;
    return 0.7 * depth * (1 - std::pow(std::pow(x, power) + std::pow(y, power), 1 / power));
  };
}

}  // namespace dressform
