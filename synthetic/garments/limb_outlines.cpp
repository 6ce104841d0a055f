#include "synthetic/garments/limb_outlines.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "synthetic/body/section.h"

namespace dressform {
namespace {

Vector2d to_frame(const Tube::Frame& frame, const Vector3d& p) {
  return {(p - frame.origin).dot(frame.u), (p - frame.origin).dot(frame.v)};
}

Tube::Frame upright_frame(const Vector3d& origin, const Vector3d& u) {
  Tube::Frame frame;
  frame.origin = origin;
  frame.axis = Vector3d::UnitY();
  frame.u = u;
  frame.v = Vector3d::UnitY().cross(u);
  return frame;
}

const char* suffix(double side) { return side > 0 ? "Left" : "Right"; }

const Vector3d& joint(const Body& body, const char* name, double side) {
  return body.joints.at(std::string(name) + suffix(side));
}

// Points of a section curve, close enough together that cutting it off at a line loses nothing.
std::vector<Vector3d> dense(const SectionCurve& curve) {
  std::vector<Vector3d> points;
  const size_t n = curve.points.size();
  for (size_t i = 0; i < n; ++i) {
    const Vector3d a = curve.points[i], b = curve.points[(i + 1) % n];
    if (i + 1 == n && !curve.closed) {
      points.push_back(a);
      break;
    }
    const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / 0.004)));
    for (int k = 0; k < steps; ++k) points.push_back(a + (b - a) * k / steps);
  }
  return points;
}

std::vector<Vector2d> in_frame(const Tube::Frame& frame, const std::vector<Vector3d>& points) {
  std::vector<Vector2d> result;
  for (const Vector3d& p : points) result.push_back(to_frame(frame, p));
  return result;
}

}  // namespace

Tube::Frame torso_frame() { return upright_frame(Vector3d::Zero(), Vector3d::UnitZ()); }

Tube::Frame leg_frame(const Body& body, double side) {
  const Vector3d& knee = joint(body, "Knee", side);
  return upright_frame(Vector3d(knee.x(), 0, knee.z()), side * Vector3d::UnitX());
}

Tube::Frame arm_frame(const Body& body, double side) {
  Tube::Frame frame;
  frame.origin = joint(body, "Shoulder", side);
  frame.axis = (joint(body, "Wrist", side) - frame.origin).normalized();
  const Vector3d out = side * Vector3d::UnitX();
  frame.u = (out - out.dot(frame.axis) * frame.axis).normalized();
  frame.v = (-frame.axis).cross(frame.u);
  return frame;
}

double arm_length(const Body& body, double side) {
  return (joint(body, "Wrist", side) - joint(body, "Shoulder", side)).norm();
}

Outline trunk_outline(const Body& body, const std::vector<Garment>& inner, double gap_m) {
  const Tube::Frame frame = torso_frame();
  const double left = joint(body, "Shoulder", 1).x(), right = joint(body, "Shoulder", -1).x();
  return [&body, &inner, gap_m, frame, left, right](double y) {
    std::vector<Vector2d> points;
    for (const Polygon& polygon : torso_part(horizontal_section(body.mesh, y))) {
      const size_t n = polygon.points.size();
      for (size_t i = 0; i < n; ++i) {
        Vector2d p = polygon.points[i];
        if (p.x() > left || p.x() < right) continue;
        points.push_back(to_frame(frame, Vector3d(p.x(), y, p.y())));
      }
    }
    for (const Garment& garment : inner)
      for (const SectionCurve& curve : plane_section(garment.textured.mesh, Vector3d(0, y, 0), Vector3d::UnitY())) {
        double middle = 0;
        for (const Vector3d& p : curve.points) middle += p.x() / static_cast<double>(curve.points.size());
        if (middle > 0.8 * left || middle < 0.8 * right) continue;  // a sleeve
        for (const Vector3d& p : curve.points) {
          const Vector2d q = to_frame(frame, p);
          points.push_back(q + gap_m * q.normalized());
        }
      }
    return points;
  };
}

Outline below_waistband(const Outline& outline, double waist_y) {
  return [outline, waist_y](double y) { return outline(std::min(y, waist_y)); };
}

Outline leg_outline(const Body& body, double side) {
  const Tube::Frame frame = leg_frame(body, side);
  return [&body, frame, side](double y) {
    std::vector<Vector2d> points;
    const auto legs = torso_part(horizontal_section(body.mesh, y));
    if (legs.size() != 2) return points;
    for (const Polygon& leg : legs)
      if (leg.centroid.x() * side > 0)
        for (const Vector2d& p : leg.points) points.push_back(to_frame(frame, Vector3d(p.x(), y, p.y())));
    return points;
  };
}

Outline arm_outline(const Body& body, double side) {
  const Tube::Frame frame = arm_frame(body, side);
  // The upper arm's thickness half way to the elbow limits what belongs to the arm nearer to the shoulder.
  const double probe = 0.55 * (joint(body, "Elbow", side) - joint(body, "Shoulder", side)).norm();
  double thickness = 0.05;
  for (const SectionCurve& curve : plane_section(body.mesh, frame.origin + probe * frame.axis, frame.axis)) {
    double largest = 0;
    for (const Vector3d& p : curve.points) largest = std::max(largest, to_frame(frame, p).norm());
    if (largest < 0.14) thickness = largest;
  }
  return [&body, frame, thickness](double s) {
    const double limit = 1.35 * thickness + 0.004;
    std::vector<Vector2d> points;
    for (const SectionCurve& curve : plane_section(body.mesh, frame.origin + s * frame.axis, frame.axis)) {
      const std::vector<Vector2d> own = in_frame(frame, dense(curve));
      const auto near = [limit](const Vector2d& q) { return q.norm() < limit; };
      // Below the armpit the arm has a curve of its own, and what is near beside it is the trunk.
      if (curve.closed && goes_round_origin(own) && std::all_of(own.begin(), own.end(), near)) return own;
      std::copy_if(own.begin(), own.end(), std::back_inserter(points), near);
    }
    return points;
  };
}

}  // namespace dressform
