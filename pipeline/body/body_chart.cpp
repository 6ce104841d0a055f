#include "pipeline/body/body_chart.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace dressform {

const Limb* BodyChart::limb_of(BodyPart part) const {
  if (is_arm(part)) return landmarks_.arm(side_of(part));
  return is_leg(part) ? landmarks_.leg(side_of(part)) : nullptr;
}

ChartPlace BodyChart::place(const Vector3d& point, BodyPart limb) const {
  const Limb* axis = limb_of(limb);
  const Vector3d down = axis ? axis->direction : Vector3d(-Vector3d::UnitY());
  const Vector3d root = axis ? axis->root : Vector3d(landmarks_.axis.x(), landmarks_.crotch_y, landmarks_.axis.z());
  const Vector3d left = landmarks_.front.cross(down).normalized(), front = down.cross(left);
  const double along = (point - root).dot(down);
  const Vector3d out = point - root - along * down;
  return {limb, axis ? along : -along, std::atan2(out.dot(left), out.dot(front)), out.norm()};
}

double BodyChart::part_of_limb(const Vector3d& point, BodyPart limb) const {
  const Limb* axis = limb_of(limb);
  return axis && axis->length > 0 ? std::clamp(axis->along(point) / axis->length, 0.0, 1.0) : 0;
}

}  // namespace dressform
