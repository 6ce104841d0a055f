#include "synthetic/body/figure_sizes.h"

#include <cmath>

namespace dressform {
namespace {

constexpr int kRays = 180;

// Distance along a ray from inside to the first place where it leaves the solid.
double leave(const Field& field, const Vector3d& origin, const Vector3d& direction) {
  double inside = 0, inside_value = field(origin), outside = 0, outside_value = inside_value;
  if (inside_value >= 0) return 0;
  while (outside_value < 0 && outside < 0.7) {
    inside = outside;
    inside_value = outside_value;
    outside += std::max(0.003, -0.8 * outside_value);
    outside_value = field(origin + outside * direction);
  }
  for (int i = 0; i < 4; ++i) {  // regula falsi on a short stretch
    const double middle = inside + (outside - inside) * inside_value / (inside_value - outside_value);
    const double value = field(origin + middle * direction);
    (value < 0 ? inside : outside) = middle;
    (value < 0 ? inside_value : outside_value) = value;
    if (std::abs(value) < 1e-6) return middle;
  }
  return inside + (outside - inside) * inside_value / (inside_value - outside_value);
}

struct PlaneSize {
  double girth = 0, breadth = 0, depth = 0;
};

PlaneSize size_in(const Slicer& slice, const SizePlane& plane) {
  std::vector<Vector2d> points = slice(plane);
  if (points.size() < 3) return {};
  Vector2d low = points[0], high = points[0];
  for (const Vector2d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return {polygon_length(convex_hull(std::move(points))), high.x() - low.x(), high.y() - low.y()};
}

SizePlane level(const Vector3d& origin) { return {origin, Vector3d::UnitX(), Vector3d::UnitZ()}; }

SizePlane across(const Vector3d& origin, const Vector3d& axis) {
  const Vector3d ahead = (Vector3d::UnitZ() - axis.z() * axis).normalized();
  return {origin, ahead.cross(axis), ahead};
}

}  // namespace

NeckPlace neck_place(const BodyLandmarks& m) {
  const double lean = 20 * M_PI / 180;  // from below the seventh vertebra up front to the Adam's apple
  return {Vector3d(0, m.neck - 0.004 * m.stature, -0.012), Vector3d(0, std::cos(lean), std::sin(lean))};
}

Slicer field_slicer(const Field& field) {
  return [&field](const SizePlane& plane) {
    std::vector<Vector2d> points;
    for (int i = 0; i < kRays; ++i) {
      const Vector2d direction(std::cos(2 * M_PI * i / kRays), std::sin(2 * M_PI * i / kRays));
      points.push_back(leave(field, plane.origin, direction.x() * plane.u + direction.y() * plane.v) * direction);
    }
    return points;
  };
}

Slicer mesh_slicer(const Mesh& mesh) {
  return [&mesh](const SizePlane& plane) {
    std::vector<Vector2d> found;
    for (const SectionCurve& curve : plane_section(mesh, plane.origin, plane.u.cross(plane.v))) {
      std::vector<Vector2d> points;
      for (const Vector3d& p : curve.points)
        points.emplace_back((p - plane.origin).dot(plane.u), (p - plane.origin).dot(plane.v));
      if (goes_round_origin(points)) found = points;  // the curves come longest first
    }
    return found;
  };
}

BodySizes measure_sizes(const BodyLandmarks& m, const std::map<std::string, Vector3d>& joints, const Slicer& slice) {
  BodySizes sizes;
  const auto girth = [&](const SizePlane& plane) { return size_in(slice, plane).girth; };
  const auto trunk = [&](double y, double& around, double& breadth, double& depth) {
    const PlaneSize size = size_in(slice, level({0, y, 0}));
    around = size.girth;
    breadth = size.breadth;
    depth = size.depth;
  };
  trunk(m.chest, sizes.chest_girth, sizes.chest_breadth, sizes.chest_depth);
  trunk(m.waist, sizes.waist_girth, sizes.waist_breadth, sizes.waist_depth);
  trunk(m.hip, sizes.hip_girth, sizes.hip_breadth, sizes.hip_depth);
  sizes.shoulder_breadth = size_in(slice, level({0, m.shoulder - 0.030 * m.stature, -0.02})).breadth;

  const NeckPlace neck = neck_place(m);
  sizes.neck_girth = girth(across(neck.center, neck.axis));
  trunk(0.9485 * m.stature, sizes.head_girth, sizes.head_breadth, sizes.head_length);

  const Vector3d &hip = joints.at("HipLeft"), &knee = joints.at("KneeLeft"), &ankle = joints.at("AnkleLeft");
  const auto leg = [&](double y) {  // in the middle of the leg
    const Vector3d &high = y > m.knee ? hip : knee, &low = y > m.knee ? knee : ankle;
    const Vector3d on = low + (y - low.y()) / (high.y() - low.y()) * (high - low);
    return girth(level(on));
  };
  sizes.thigh_girth = leg(m.crotch - 0.016 * m.stature);
  sizes.lower_thigh_girth = leg(m.knee + 0.034 * m.stature);
  sizes.calf_girth = leg(m.ankle + 0.68 * (m.knee - m.ankle));
  sizes.ankle_girth = leg(m.ankle + 0.028 * m.stature);

  const Vector3d &shoulder = joints.at("ShoulderLeft"), &elbow = joints.at("ElbowLeft"),
                 &wrist = joints.at("WristLeft");
  const auto bone = [&](const Vector3d& from, const Vector3d& to, double t) {
    return girth(across(from + t * (to - from), (to - from).normalized()));
  };
  sizes.upper_arm_girth = bone(shoulder, elbow, 0.54);
  sizes.forearm_girth = bone(elbow, wrist, 0.20);
  sizes.wrist_girth = bone(elbow, wrist, 0.96);
  return sizes;
}

}  // namespace dressform
