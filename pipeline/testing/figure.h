#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/geometry/lattice.h"
#include "scenes/mesh.h"

namespace dressform {

// A closed figure of capsules for tests: stature, breadth over the average build's, arms so far out from the vertical,
// feet (and a seat and a nose) that tell front from back, facing `yaw` from +z.
struct FigureSpec {
  double stature_m = 1.8, breadth = 1, arm_deg = 15, yaw = 0;
};

inline double capsule_distance(const Vector3d& p, const Vector3d& a, const Vector3d& b, double radius) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm() - radius;
}

// Trunk: a cylinder of radius 0.15 m times `breadth` between 1/2 and 3/4 of the stature.
inline Mesh make_figure(const FigureSpec& spec, double step_m = 0.016) {
  const double h = spec.stature_m / 1.8, b = spec.breadth, reach = std::tan(spec.arm_deg * M_PI / 180);
  const Lattice lattice = make_lattice({-0.65, 0, -0.65}, {0.65, 1.82 * h, 0.65}, 0.03, step_m);
  const Eigen::AngleAxisd turn(-spec.yaw, Vector3d::UnitY());
  std::vector<float> field(lattice.count());
  for (std::size_t i = 0; i < field.size(); ++i) {
    Vector3d p = turn * lattice.point(i);
    p.y() /= h;
    double d = capsule_distance(p, {0, 1.0, 0}, {0, 1.30, 0}, 0.15 * b);
    d = std::min(d, capsule_distance(p, {0, 1.4, 0}, {0, 1.7, 0}, 0.06));
    d = std::min(d, (p - Vector3d(0, 1.68, 0)).norm() - 0.10);
    d = std::min(d, capsule_distance(p, {0, 1.67, 0.08}, {0, 1.66, 0.11}, 0.02));
    for (const double side : {-1.0, 1.0}) {
      d = std::min(d, capsule_distance(p, {side * 0.09 * b, 0.06, 0}, {side * 0.09 * b, 0.98, 0}, 0.075 * b));
      d = std::min(d, capsule_distance(p, {side * 0.09 * b, 0.04, 0}, {side * 0.09 * b, 0.04, 0.14}, 0.04));
      const double shoulder = 0.20 * b, hand = shoulder + 0.65 * reach;
      d = std::min(d, capsule_distance(p, {0, 1.40, 0}, {side * shoulder, 1.40, 0}, 0.05));
      d = std::min(d, capsule_distance(p, {side * shoulder, 1.40, 0}, {side * hand, 0.75, 0}, 0.045));
    }
    field[i] = static_cast<float>(d);
  }
  return lattice_surface(lattice, field);
}

// Open cylinder about the y axis, outward; `waves` folds of the given depth.
inline TexturedMesh make_tube(double radius_m, double from_y, double to_y, double depth_m = 0, int waves = 12) {
  constexpr int kAround = 120, kRows = 30;
  TexturedMesh tube;
  for (int row = 0; row <= kRows; ++row)
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * M_PI * i / kAround, r = radius_m + depth_m * std::sin(waves * angle);
      tube.mesh.vertices.emplace_back(r * std::sin(angle), to_y + row * (from_y - to_y) / kRows, r * std::cos(angle));
    }
  for (int row = 0; row < kRows; ++row)
    for (int i = 0; i < kAround; ++i) {
      const int a = row * kAround + i, b = row * kAround + (i + 1) % kAround;
      tube.mesh.triangles.emplace_back(a, a + kAround, b + kAround);
      tube.mesh.triangles.emplace_back(a, b + kAround, b);
    }
  tube.corner_uv.assign(tube.mesh.triangles.size(), {Vector2f(0, 0), Vector2f(0, 1), Vector2f(1, 1)});
  tube.texture = cv::Mat(4, 4, CV_8UC3, cv::Scalar(10, 20, 30));
  return tube;
}

}  // namespace dressform
