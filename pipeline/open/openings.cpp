#include "pipeline/open/openings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dressform {
namespace {

constexpr double kEndToRim_m = 0.05;                     // the closed surface runs on this far beyond a rim
constexpr double kNeckBand_m = 0.03, kRimBand_m = 0.06;  // of the closed surface's ends, whose middle is the rim's
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
  opening.limb = part;
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
int shoulder_at(const Vector3d& point, const Landmarks& limbs) {
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
                                      const Landmarks& limbs) {
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
    Vector3d neck = middle(closed, high - kNeckBand_m, high, limbs.neck);
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
  const Vector3d waist = middle(closed, high - kRimBand_m, high, Vector3d(0, high, 0));
  if (kind == "trousers") {
    if (!limbs.left_leg || !limbs.right_leg) return {};
    openings.push_back(cylinder("waist", waist, up, limbs.front));
    openings.push_back(of_limb("left_ankle", *limbs.left_leg, BodyPart::left_leg, closed, parts, limbs.front));
    openings.push_back(of_limb("right_ankle", *limbs.right_leg, BodyPart::right_leg, closed, parts, limbs.front));
  } else if (kind == "skirt") {
    openings.push_back(cylinder("waist", waist, up, limbs.front));
    openings.push_back(cylinder("hem", middle(closed, low, low + kRimBand_m, waist), -up, limbs.front));
  }
  return openings;
}

bool belongs(const Opening& opening, BodyPart part, const Vector3d& point, const Landmarks& landmarks) {
  if (is_arm(opening.limb) || is_arm(part)) return part == opening.limb;
  if (!is_leg(opening.limb)) return true;
  const double side = (point - landmarks.hips()).dot(landmarks.left);
  return point.y() < landmarks.crotch_y && (side > 0) == (side_of(opening.limb) == 0);
}

const Opening* opening_near(const std::vector<Opening>& openings, const Vector3d& point, BodyPart part,
                            const Landmarks& limbs) {
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

}  // namespace dressform
