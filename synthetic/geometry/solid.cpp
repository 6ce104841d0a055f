#include "synthetic/geometry/solid.h"

#include <algorithm>
#include <cmath>

namespace dressform {

double smooth_union(double a, double b, double blend) {
  const double h = std::max(blend - std::abs(a - b), 0.0);
  return std::min(a, b) - (blend > 0 ? h * h / (4 * blend) : 0);
}

double smooth_intersection(double a, double b, double blend) { return -smooth_union(-a, -b, blend); }

double ellipsoid_field(const Vector3d& point, const Vector3d& center, const Vector3d& radii) {
  const Vector3d d = point - center;
  const double k0 = d.cwiseQuotient(radii).norm();
  const double k1 = d.cwiseQuotient(radii.cwiseProduct(radii)).norm();
  return k1 > 1e-12 ? k0 * (k0 - 1) / k1 : -radii.minCoeff();
}

double capsule_field(const Vector3d& point, const Vector3d& a, const Vector3d& b, double radius_a, double radius_b) {
  const Vector3d axis = b - a;
  const double t = std::clamp((point - a).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
  return (point - a - t * axis).norm() - (radius_a + t * (radius_b - radius_a));
}

void Solid::add(const Tube& tube, double blend) {
  Eigen::AlignedBox3d box;
  for (int row = 0; row < tube.rows(); ++row) {
    const double s = tube.s_min() + (tube.s_max() - tube.s_min()) * row / (tube.rows() - 1);
    for (int i = 0; i < 24; ++i) {
      const double angle = i * 0.2617993877991494;
      box.extend(tube.point(s, angle, 1.02 * tube.radius(s, angle)));
    }
  }
  parts_.push_back({[tube](const Vector3d& p) { return tube.field(p); }, box, blend, false});
}

void Solid::add_ellipsoid(const Vector3d& center, const Vector3d& radii, double blend) {
  parts_.push_back({[center, radii](const Vector3d& p) { return ellipsoid_field(p, center, radii); },
                    {center - radii, center + radii},
                    blend,
                    false});
}

void Solid::carve_ellipsoid(const Vector3d& center, const Vector3d& radii, double blend) {
  add_ellipsoid(center, radii, blend);
  parts_.back().carve = true;
}

void Solid::add_capsule(const Vector3d& a, const Vector3d& b, double radius_a, double radius_b, double blend) {
  const Vector3d margin = Vector3d::Constant(std::max(radius_a, radius_b));
  Eigen::AlignedBox3d box(a.cwiseMin(b) - margin, a.cwiseMax(b) + margin);
  parts_.push_back({[=](const Vector3d& p) { return capsule_field(p, a, b, radius_a, radius_b); }, box, blend, false});
}

void Solid::add_field(const Field& field, const Eigen::AlignedBox3d& box, double blend) {
  parts_.push_back({field, box, blend, false});
}

void Solid::cut_below(double y) { floor_ = y; }

double Solid::field(const Vector3d& point) const {
  double value = 1e3;
  for (const Part& part : parts_) {
    const double away = part.box.exteriorDistance(point);
    if (part.carve) {
      if (away < part.blend) value = smooth_intersection(value, -part.field(point), part.blend);
    } else if (away < value + part.blend) {
      // Far from its box a part needs no exact value.
      value = smooth_union(value, away > 0.08 + part.blend ? away : part.field(point), part.blend);
    }
  }
  return smooth_intersection(value, floor_ - point.y(), 0.006);
}

}  // namespace dressform
