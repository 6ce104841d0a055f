#include "synthetic/garments/neckline.h"

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

// Half an ellipse below `middle_y`, seen from the front.
struct Opening {
  double middle_y, half_width, front_depth, back_depth;
  double point;  // of the front: 0 round, 1 straight sides down to a sharp point

  double at(const Vector3d& p) const {
    const double forward = std::clamp((p.z() + 0.105) / 0.075, 0.0, 1.0);
    const double t = forward * forward * (3 - 2 * forward);
    const double depth = back_depth + t * (front_depth - back_depth);
    const double x = std::abs(p.x()) / half_width, y = std::max(middle_y - p.y(), 0.0) / depth;
    const double power = 2 - point * t;
    return 0.7 * depth * (1 - std::pow(std::pow(x, power) + std::pow(y, power), 1 / power));
  }
};

constexpr double kSeamDepth = 0.068;  // of a collar's seam in front, below the neck's side, for a person of 1.75 m

double size_of(const BodyLandmarks& landmarks) { return landmarks.stature / 1.75; }
double side_height(const BodyLandmarks& landmarks) { return landmarks.neck + 0.020; }

}  // namespace

Level neckline(const GarmentSpec& spec, const BodyLandmarks& landmarks) {
  const double size = size_of(landmarks);
  const Opening opening{side_height(landmarks), 0.104 * size, spec.neck_depth_m * size, 0.034 * size,
                        spec.neck == "v" ? 0.85 : 0};
  return [opening](const Vector3d& p) { return opening.at(p); };
}

Level collar_seam(const BodyLandmarks& landmarks, const Tube& trunk) {
  const double size = size_of(landmarks), y = side_height(landmarks);
  // Not narrower than the cloth at that height, or the cut would leave a piece round the neck.
  const double neck = std::max(trunk.radius(y, M_PI / 2), trunk.radius(y, -M_PI / 2));
  const Opening opening{y, std::max(0.072 * size, neck + 0.010), kSeamDepth * size, 0.030 * size, 0};
  return [opening](const Vector3d& p) { return opening.at(p); };
}

Level collar_slit(const BodyLandmarks& landmarks, double length_m) {
  const double size = size_of(landmarks), top = side_height(landmarks) - (kSeamDepth - 0.01) * size,
               bottom = side_height(landmarks) - kSeamDepth * size - length_m;
  return [=](const Vector3d& p) {
    if (p.z() < 0) return -1.0;
    const double up = std::clamp((p.y() - bottom) / (top - bottom), 0.0, 1.0);
    const double half_width = 0.007 + 0.009 * up;
    return std::min({half_width - std::abs(p.x()), p.y() - bottom, top + 0.05 - p.y()});
  };
}

}  // namespace dressform
