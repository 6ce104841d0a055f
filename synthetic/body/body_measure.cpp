#include "synthetic/body/body_measure.h"

#include <algorithm>
#include <cmath>

#include "fmt/format.h"
#include "scenes/error.h"
#include "synthetic/body/section.h"

namespace dressform {
namespace {

// The height in [low, high] where `below` stops to hold; it holds at `low`.
template <class Predicate>
double bisect_height(double low, double high, const Predicate& below) {
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (low + high);
    (below(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// The height in [low, high], by steps of 4 mm, where the girth is largest (sign 1) or smallest (sign -1).
double extreme_girth(const Mesh& mesh, double low, double high, double sign) {
  double best_y = 0.5 * (low + high), best = -1e9;
  for (double y = low; y <= high; y += 0.004) {
    const double value = sign * tape_girth(mesh, y);
    if (value > best) {
      best = value;
      best_y = y;
    }
  }
  return best_y;
}

bool has_two_legs(const Mesh& mesh, double y) { return torso_part(horizontal_section(mesh, y)).size() == 2; }

// Beside the torso one arm at least is a polygon of its own.
bool has_free_arm(const Mesh& mesh, double y) {
  const auto polygons = horizontal_section(mesh, y);
  return polygons.size() >= 2 && polygons[1].area > 1e-3 && polygons[1].area < 0.5 * polygons[0].area;
}

double find_crotch(const Mesh& mesh, double stature, const std::string& where) {
  double y = 0.58 * stature;
  while (y > 0.3 * stature && !has_two_legs(mesh, y)) y -= 0.01 * stature;
  if (y <= 0.3 * stature)
    throw InputError(where, "found no height where two legs part; expected a standing figure, y up, feet at y = 0");
  return bisect_height(y, y + 0.01 * stature, [&](double at) { return has_two_legs(mesh, at); });
}

double find_armpit(const Mesh& mesh, double stature) {
  double y = 0.86 * stature;
  while (y > 0.62 * stature && !has_free_arm(mesh, y)) y -= 0.005 * stature;
  if (y <= 0.62 * stature) return 0.757 * stature;  // arms held out level, or none
  return bisect_height(y, y + 0.005 * stature, [&](double at) { return has_free_arm(mesh, at); });
}

BodyLandmarks find_landmarks(const Mesh& mesh, const std::string& where) {
  BodyLandmarks marks;
  for (const Vector3d& v : mesh.vertices) marks.stature = std::max(marks.stature, v.y());
  const double h = marks.stature;
  marks.crotch = find_crotch(mesh, h, where);
  marks.armpit = find_armpit(mesh, h);
  const double trunk = marks.armpit - marks.crotch;
  if (trunk < 0.1 * h) throw InputError(where, "found no trunk between crotch and armpits; expected a standing figure");
  const double narrow = extreme_girth(mesh, 0.82 * h, 0.90 * h, -1);
  marks.neck = std::max(narrow - 0.015 * h, marks.armpit + 0.08 * h);
  marks.shoulder = marks.armpit + 0.6 * (marks.neck - marks.armpit);
  marks.waist = extreme_girth(mesh, marks.crotch + 0.30 * trunk, marks.crotch + 0.70 * trunk, -1);
  marks.chest = extreme_girth(mesh, marks.waist + 0.12 * h, marks.armpit - 0.025 * h, 1);
  marks.hip = extreme_girth(mesh, marks.crotch + 0.012 * h, marks.waist - 0.04 * h, 1);
  marks.knee = 0.577 * marks.crotch;
  marks.ankle = 0.042 * h;
  return marks;
}

// Center (x, z) of the leg on the side of `sign` at height y.
Vector3d leg_center(const Mesh& mesh, double y, double sign) {
  const auto legs = torso_part(horizontal_section(mesh, y));
  for (const Polygon& leg : legs)
    if (legs.size() == 2 && leg.centroid.x() * sign > 0) return {leg.centroid.x(), y, leg.centroid.y()};
  return {sign * 0.09, y, 0};
}

// Half-breadth and middle depth of the torso at a height.
struct TorsoExtent {
  double low_x = 0, high_x = 0, z = 0;
};
TorsoExtent torso_extent(const Mesh& mesh, double y) {
  TorsoExtent extent;
  const auto part = torso_part(horizontal_section(mesh, y));
  if (part.empty()) return extent;
  extent.z = part[0].centroid.y();
  for (const Polygon& polygon : part)
    for (const Vector2d& p : polygon.points) {
      extent.low_x = std::min(extent.low_x, p.x());
      extent.high_x = std::max(extent.high_x, p.x());
    }
  return extent;
}

void add_arm_joints(const Mesh& mesh, const BodyLandmarks& m, double sign, const std::string& side,
                    std::map<std::string, Vector3d>& joints) {
  const TorsoExtent chest = torso_extent(mesh, m.armpit - 0.02 * m.stature);
  const double chest_side = sign > 0 ? chest.high_x : chest.low_x;
  const Vector3d shoulder(chest_side + sign * 0.018 * m.stature, m.shoulder - 0.023 * m.stature, chest.z);
  // The finger tip is the point beside the body that is furthest from the shoulder.
  const TorsoExtent hip = torso_extent(mesh, m.hip);
  const double beside = std::max(std::abs(sign > 0 ? hip.high_x : hip.low_x), std::abs(chest_side)) + 0.02;
  Vector3d tip = shoulder + Vector3d(sign * 0.2, -0.7, 0);
  double furthest = 0;
  for (const Vector3d& v : mesh.vertices)
    if (sign * v.x() > beside && v.y() > m.knee && (v - shoulder).norm() > furthest) {
      furthest = (v - shoulder).norm();
      tip = v;
    }
  joints["Shoulder" + side] = shoulder;
  joints["Elbow" + side] = shoulder + 0.39 * (tip - shoulder);
  joints["Wrist" + side] = shoulder + 0.745 * (tip - shoulder);
  joints["Hand" + side] = shoulder + 0.86 * (tip - shoulder);
  joints["HandTip" + side] = tip;
  joints["Thumb" + side] = shoulder + 0.88 * (tip - shoulder) + Vector3d(0, 0, 0.03);
}

std::map<std::string, Vector3d> find_joints(const Mesh& mesh, const BodyLandmarks& m) {
  const double h = m.stature;
  const auto middle = [&](double y) {
    const TorsoExtent extent = torso_extent(mesh, y);
    return Vector3d(0.5 * (extent.low_x + extent.high_x), y, extent.z);
  };
  std::map<std::string, Vector3d> joints;
  joints["SpineBase"] = middle(m.hip + 0.015 * h);
  joints["SpineMid"] = middle(0.5 * (m.waist + m.chest));
  joints["SpineShoulder"] = middle(m.shoulder - 0.005 * h);
  joints["Neck"] = middle(m.neck + 0.005 * h);
  joints["Head"] = middle(0.938 * h);
  for (const double sign : {1.0, -1.0}) {
    const std::string side = sign > 0 ? "Left" : "Right";
    const Vector3d thigh = leg_center(mesh, m.crotch - 0.02 * h, sign);
    joints["Hip" + side] = Vector3d(thigh.x(), m.hip + 0.01 * h, thigh.z());
    joints["Knee" + side] = leg_center(mesh, m.knee, sign);
    joints["Ankle" + side] = leg_center(mesh, m.ankle + 0.015 * h, sign);
    joints["Foot" + side] = joints["Ankle" + side] + Vector3d(0, 0.02 - m.ankle, 0.075 * h);
    add_arm_joints(mesh, m, sign, side, joints);
  }
  return joints;
}

// Where the first edge lies that has one triangle or more than two.
std::string first_open_place(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> count;
  for (const Vector3i& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++count[std::minmax(t[k], t[(k + 1) % 3])];
  for (const auto& [edge, triangles] : count) {
    const Vector3d place = 0.5 * (mesh.vertices[edge.first] + mesh.vertices[edge.second]);
    if (triangles != 2) return fmt::format("({:.3f}, {:.3f}, {:.3f}) m", place.x(), place.y(), place.z());
  }
  return "no place";
}

}  // namespace

Body measure_body(Mesh mesh, const std::string& where) {
  const Topology shape = topology(mesh);
  if (!shape.closed())
    throw InputError(where, fmt::format("found {} open and {} overused edges, the first at {}; expected a closed body",
                                        shape.boundary_edges, shape.non_manifold_edges, first_open_place(mesh)));
  Body body;
  body.landmarks = find_landmarks(mesh, where);
  body.joints = find_joints(mesh, body.landmarks);
  body.mesh = std::move(mesh);
  return body;
}

}  // namespace dressform
