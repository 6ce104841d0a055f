#include "pipeline/open/openings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dressform {
namespace {

constexpr double kEndToRim_m = 0.05;   // the closed surface runs on this far beyond a rim
constexpr double kBelowNeck_m = 0.20;  // the neck's polar centre lies this far below the closed surface's end

Opening cylinder(const std::string& name, const Vector3d& centre, const Vector3d& axis, const Vector3d& front) {
  Opening opening;
  opening.name = name;
  opening.centre = centre;
  opening.axis = axis.normalized();
  opening.zero = (front - opening.axis * opening.axis.dot(front)).normalized();
  return opening;
}

// Middle of the mesh's section between two heights.
Vector3d middle(const Mesh& mesh, double low, double high, const Vector3d& otherwise) {
  Vector3d least = Vector3d::Constant(std::numeric_limits<double>::infinity()), most = -least;
  for (const Vector3d& v : mesh.vertices) {
    if (v.y() < low || v.y() > high) continue;
    least = least.cwiseMin(v);
    most = most.cwiseMax(v);
  }
  return least.x() > most.x() ? otherwise : Vector3d((least + most) / 2);
}

// The opening of a sleeve or leg: the limb's axis, moved to pass through the limb's middle where the cloth ends,
// because limbs bend and the axis has to pass through the rim.
Opening of_limb(const std::string& name, const Limb& limb, BodyPart part, const Mesh& mesh,
                const std::vector<BodyPart>& parts, const Vector3d& front) {
  Opening opening = cylinder(name, limb.root, limb.direction, front);
  double end = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (parts[i] == part) end = std::max(end, limb.along(mesh.vertices[i]));
  if (!std::isfinite(end)) return opening;
  const auto centre = std::min_element(limb.centres.begin(), limb.centres.end(), [&](const auto& a, const auto& b) {
    return std::abs(limb.along(a) - end + kEndToRim_m) < std::abs(limb.along(b) - end + kEndToRim_m);
  });
  const Vector3d shift = *centre - opening.centre;
  opening.centre += shift - opening.axis * opening.axis.dot(shift);
  return opening;
}

// Whether a point lies on a shoulder, further out than the arm's axis where it leaves the trunk: short sleeves end
// there, although the body below counts as trunk. 0 left, 1 right, -1 neither.
int shoulder_at(const Vector3d& point, const BodyLimbs& limbs) {
  for (int side = 0; side < 2; ++side) {
    const Limb* arm = limbs.arm(side);
    if (!arm || point.y() < arm->root.y()) continue;
    if ((point - arm->root).dot(limbs.outwards(side)) > 0) return side;
  }
  return -1;
}

}  // namespace

double Opening::along(const Vector3d& point) const {
  const Vector3d d = point - centre;
  if (shape == Shape::cylinder) return d.dot(axis);
  return -kPolarRadius_m * std::atan2((d - axis * axis.dot(d)).norm(), axis.dot(d));
}

double Opening::angle(const Vector3d& point) const {
  const Vector3d d = point - centre;
  return std::atan2(d.dot(axis.cross(zero)), d.dot(zero));
}

std::vector<Opening> garment_openings(const std::string& kind, const Mesh& closed, const std::vector<BodyPart>& parts,
                                      const BodyLimbs& limbs) {
  std::vector<Opening> openings;
  if (closed.vertices.empty()) return openings;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vector3d& v : closed.vertices) {
    low = std::min(low, v.y());
    high = std::max(high, v.y());
  }
  const Vector3d up = Vector3d::UnitY();
  if (kind == "shirt" || kind == "dress") {
    if (!limbs.left_arm || !limbs.right_arm) return {};
    Vector3d neck = middle(closed, high - 0.03, high, limbs.neck);
    neck.y() = high - kBelowNeck_m;
    Opening opening = cylinder("neck", neck, up, limbs.front);
    opening.shape = Opening::Shape::polar;
    openings.push_back(opening);
    openings.push_back(of_limb("left_cuff", *limbs.left_arm, BodyPart::left_arm, closed, parts, limbs.front));
    openings.push_back(of_limb("right_cuff", *limbs.right_arm, BodyPart::right_arm, closed, parts, limbs.front));
    Vector3d waist = limbs.neck;
    waist.y() = limbs.waist_y;
    openings.push_back(cylinder("hem", waist, -up, limbs.front));
    return openings;
  }
  const Vector3d waist = middle(closed, high - 0.06, high, Vector3d(0, high, 0));
  if (kind == "trousers") {
    if (!limbs.left_leg || !limbs.right_leg) return {};
    openings.push_back(cylinder("waist", waist, up, limbs.front));
    openings.push_back(of_limb("left_ankle", *limbs.left_leg, BodyPart::left_leg, closed, parts, limbs.front));
    openings.push_back(of_limb("right_ankle", *limbs.right_leg, BodyPart::right_leg, closed, parts, limbs.front));
  } else if (kind == "skirt") {
    openings.push_back(cylinder("waist", waist, up, limbs.front));
    openings.push_back(cylinder("hem", middle(closed, low, low + 0.06, waist), -up, limbs.front));
  }
  return openings;
}

std::string closed_bottom_kind(const Mesh& closed, const BodyLimbs& limbs, const std::string& otherwise) {
  constexpr double kFork_m = 0.03;    // legs come apart at most this far below the crotch
  constexpr double kEnd_m = 0.08;     // a hem's folds may come apart as well
  constexpr double kLeastPart = 0.2;  // a leg's section against the other's
  constexpr double kAll = 0.9;        // of the levels
  constexpr int kFewestLevels = 3;
  const Sections sections = horizontal_sections(closed);
  int forked = 0, whole = 0;
  for (int i = 0; i < static_cast<int>(sections.levels.size()); ++i) {
    const auto& loops = sections.levels[i];
    if (loops.empty() || sections.y(i) > limbs.crotch_y - kFork_m || sections.y(i) < sections.first_y + kEnd_m)
      continue;
    ++(loops.size() > 1 && loops[1].area_m2 > kLeastPart * loops[0].area_m2 ? forked : whole);
  }
  const int levels = forked + whole;
  if (levels < kFewestLevels) return otherwise;
  if (forked >= kAll * levels) return "trousers";
  return whole >= kAll * levels ? "skirt" : otherwise;
}

const Opening* opening_near(const std::vector<Opening>& openings, const Vector3d& point, BodyPart part,
                            const BodyLimbs& limbs) {
  const auto named = [&](const char* name) -> const Opening* {
    for (const Opening& opening : openings)
      if (opening.name == name) return &opening;
    return nullptr;
  };
  const bool top = named("neck") != nullptr;
  if (top) {
    const int shoulder = part == BodyPart::torso ? shoulder_at(point, limbs) : -1;
    if (part == BodyPart::left_arm || shoulder == 0) return named("left_cuff");
    if (part == BodyPart::right_arm || shoulder == 1) return named("right_cuff");
    return named(point.y() > (limbs.armpit_y + limbs.waist_y) / 2 ? "neck" : "hem");
  }
  if (is_arm(part)) part = BodyPart::torso;
  if (point.y() > (limbs.waist_y + limbs.crotch_y) / 2 || (part == BodyPart::torso && point.y() > limbs.crotch_y))
    return named("waist");
  if (named("hem")) return named("hem");
  const Vector3d middle = limbs.left_leg && limbs.right_leg ? limbs.hips() : Vector3d::Zero();
  const double side = (point - middle).dot(limbs.left);
  return named(part == BodyPart::left_leg || (part != BodyPart::right_leg && side > 0) ? "left_ankle" : "right_ankle");
}

std::optional<Vector3d> front_from_prior(const CaptureSession& session, const Registration& registration) {
  if (!session.prior) return {};
  Vector3d sum = Vector3d::Zero();
  for (const auto& [name, model_from_sensor] : registration.model_from_sensor) {
    const auto world_from_sensor = session.prior->world_from_sensor.find(name);
    if (world_from_sensor == session.prior->world_from_sensor.end()) continue;
    sum += model_from_sensor.linear() * world_from_sensor->second.linear().transpose() * Vector3d::UnitZ();
  }
  sum.y() = 0;
  if (sum.norm() < 0.3) return {};
  return Vector3d(sum.normalized());
}

}  // namespace dressform
