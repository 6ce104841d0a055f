#include <algorithm>
#include <cmath>
#include <memory>

#include "fmt/format.h"
#include "scenes/error.h"
#include "scenes/random.h"
#include "synthetic/garments/garment_shape.h"
#include "synthetic/garments/hood.h"
#include "synthetic/garments/limb_outlines.h"
#include "synthetic/garments/neckline.h"
#include "synthetic/garments/shirt_panels.h"
#include "synthetic/garments/underarm.h"

namespace dressform {
namespace {

constexpr double kBack = -0.02;       // of the torso's middle and of the side seams, z in m
constexpr double kClearance = 0.006;  // of the cloth off the body, m
constexpr double kRib = 0.03;         // width of the band at the neck, m
constexpr double kBlouse = 0.25;      // how much longer a tucked shirt is cut just above the waist
constexpr double kRibDraw = 0.10;     // by how much it is shorter than the rim that it is sewn to

// Cloth stretched over the trunk and what is worn below.
ClothRows taut_torso(const Body& body, const std::vector<Garment>& inner, double hem_y) {
  return taut_rows(torso_frame(), hem_y - 0.05, body.landmarks.neck + 0.05, trunk_outline(body, inner, 0.002),
                   [](double) { return Vector2d(kBack, 0); });
}

ClothRows shirt_torso(const GarmentSpec& spec, const Body& body, const ClothRows& taut) {
  const BodyLandmarks& m = body.landmarks;
  const bool dress = spec.kind == "dress";
  const ClothRows least = grown(taut, kClearance);
  // Cloth hangs from the chest and the shoulder blades (downwards is backwards along s) and rises freely to the neck.
  const ClothRows hung = smoothed(span_hollows(taut, 4.0, dress ? 0.30 : 0.10), 0.012, 0.06);
  const int chest = hung.row_of(m.chest);
  const double asked = (tape_girth(body.mesh, m.chest) + spec.ease_m) / (1 + spec.fullness);
  const double ease = std::max(0.0, asked - row_girth(hung, chest)) / (2 * M_PI);
  ClothRows eased =
      displaced(hung, [&](double s, double) { return ease + (dress ? 0.07 * std::max(0.0, m.hip - s) : 0.0); });
  if (spec.tucked)  // drawn in by what is worn over it
    for (int row = 0; row < eased.rows(); ++row) {
      const double in = std::clamp((m.waist + 0.06 - eased.s(row)) / 0.06, 0.0, 1.0);
      for (int i = 0; i < eased.angles; ++i) eased.at(row, i) += in * (least.at(row, i) - eased.at(row, i));
    }
  return no_smaller(eased, least, 0.006);
}

// Height at which the trunk's cloth ends.
double hem_height(const GarmentSpec& spec, const BodyLandmarks& m) {
  if (spec.kind == "dress") return m.waist - std::clamp(spec.length, 0.25, 1.0) * (m.waist - m.ankle);
  if (spec.tucked) return m.waist - std::min(spec.hem_below_waist_m, 0.5 * (m.waist - m.crotch));
  return m.waist - spec.hem_below_waist_m;
}

ClothRows taut_sleeve(const Body& body, double side, double cuff) {
  return taut_rows(arm_frame(body, side), -0.055, cuff + 0.035, arm_outline(body, side),
                   [](double) { return Vector2d(0, 0); });
}

ClothRows shirt_sleeve(const GarmentSpec& spec, const ClothRows& taut) {
  const ClothRows least = grown(taut, kClearance);
  const ClothRows hung = smoothed(span_hollows(taut, 0.10, 6.0), 0.012, 0.08);
  const double ease = 0.004 + 0.6 * spec.ease_m / (2 * M_PI);
  // On the shoulder the cloth lies close.
  const auto height = [&](double s, double) { return 0.005 + std::clamp(s / 0.12, 0.0, 1.0) * (ease - 0.005); };
  return no_smaller(displaced(hung, height), least, 0.005);
}

Field field_of(const Tube& tube) {
  return [tube](const Vector3d& p) { return tube.field(p); };
}

// What a shirt is put together from.
struct ShirtParts {
  GarmentSpec spec;
  BodyLandmarks landmarks;
  double hem_y = 0;
  Tube torso, left, right;
  double left_cuff = 0, right_cuff = 0;  // along the arms
  Underarm left_gap, right_gap;
  std::shared_ptr<const Hood> hood;  // null: none

  const Tube& sleeve(const Vector3d& p) const { return p.x() > 0 ? left : right; }

  // Positive where a place belongs to the sleeve rather than the torso: by the cloth, and beside the gap by the body.
  double sleeve_over_torso(const Vector3d& p) const {
    const double by_cloth = torso.field(p) - sleeve(p).field(p);
    const Underarm& gap = p.x() > 0 ? left_gap : right_gap;
    if (!gap.start_y()) return by_cloth;
    const double t = std::clamp((*gap.start_y() - p.y()) / 0.02, 0.0, 1.0);
    return by_cloth + t * (gap.nearer_to_arm(p) - by_cloth);
  }

  // Part by which the trunk is cut wider than it lies: from under the arms down, a dress most at its hem.
  double wider(double y) const {
    const BodyLandmarks& m = landmarks;
    const double flare = spec.kind == "dress" ? spec.flare : 0, hip = m.hip + 0.05;
    const double loose_to = spec.tucked ? m.waist + 0.06 : -1;  // below, what is worn over it holds it smooth
    if (y < loose_to) return 0.0;
    return spec.fullness * std::clamp((m.armpit + 0.02 - y) / 0.10, 0.0, 1.0) +
           flare * std::clamp((hip - y) / std::max(0.1, hip - hem_y), 0.0, 1.1);
  }

  // A tucked shirt is longer above the waist than the way it goes: it hangs over.
  double longer(double y) const {
    return spec.tucked ? kBlouse * std::max(0.0, 1 - std::abs(y - landmarks.waist - 0.08) / 0.08) : 0.0;
  }
};
using Parts = std::shared_ptr<const ShirtParts>;

Parts shirt_parts(const GarmentSpec& spec, const Body& body, const std::vector<Garment>& inner) {
  const double hem_y = hem_height(spec, body.landmarks);
  const ClothRows trunk = taut_torso(body, inner, hem_y);
  const double left_cuff = std::clamp(spec.sleeve, 0.1, 1.0) * arm_length(body, 1);
  const double right_cuff = std::clamp(spec.sleeve, 0.1, 1.0) * arm_length(body, -1);
  const ClothRows left_arm = taut_sleeve(body, 1, left_cuff), right_arm = taut_sleeve(body, -1, right_cuff);
  return std::make_shared<const ShirtParts>(ShirtParts{
      spec, body.landmarks, hem_y, shirt_torso(spec, body, trunk).tube(), shirt_sleeve(spec, left_arm).tube(),
      shirt_sleeve(spec, right_arm).tube(), left_cuff, right_cuff,
      Underarm(trunk.tube(), left_arm.tube(), 1, left_cuff), Underarm(trunk.tube(), right_arm.tube(), -1, right_cuff),
      spec.collar == "hood" ? std::make_shared<const Hood>(body, spec.neck_depth_m) : nullptr});
}

Field solid(const Parts& parts, const Field& trunk_cloth, const Field& left_sleeve, const Field& right_sleeve) {
  return parts->right_gap.parted(parts->left_gap.parted([=](const Vector3d& p) {
    const double sleeve = p.x() > 0 ? left_sleeve(p) : right_sleeve(p);
    const double shirt = smooth_union(trunk_cloth(p), sleeve, 0.028);
    return parts->hood ? smooth_union(shirt, parts->hood->field(p), 0.04) : shirt;
  }));
}

Eigen::AlignedBox3d box_of(const ShirtParts& parts) {
  const Vector3d left = parts.left.point(parts.left.s_max(), 0, 0),
                 right = parts.right.point(parts.right.s_max(), 0, 0);
  const double reach = std::max(std::abs(left.x()), std::abs(right.x()));
  return {Vector3d(-reach - 0.12, std::min({parts.torso.s_min(), left.y(), right.y()}) - 0.06, -0.40),
          Vector3d(reach + 0.12, std::max(parts.torso.s_max(), parts.hood ? parts.hood->top() : 0) + 0.02, 0.40)};
}

void cut_neck(const Parts& parts, GarmentShape& shape) {
  const GarmentSpec& spec = parts->spec;
  if (parts->hood) {
    shape.cuts.push_back({"neck", [hood = parts->hood](const Vector3d& p) { return hood->opening(p); }});
  } else if (spec.collar == "polo") {
    shape.collar = CollarCut{collar_seam(parts->landmarks, parts->torso)};
    shape.cuts.push_back({"neck", [seam = shape.collar->seam, slit = collar_slit(parts->landmarks, spec.neck_depth_m)](
                                      const Vector3d& p) { return std::max(seam(p), slit(p)); }});
  } else {
    shape.cuts.push_back({"neck", neckline(spec, parts->landmarks)});
  }
}

void cut_cuffs_and_hem(const Parts& parts, const Body& body, Seed seed, GarmentShape& shape) {
  for (const double side : {1.0, -1.0}) {
    const Tube::Frame frame = arm_frame(body, side);
    const double end = side > 0 ? parts->left_cuff : parts->right_cuff;
    shape.cuts.push_back({side > 0 ? "left_cuff" : "right_cuff", [=](const Vector3d& p) {
                            if (p.x() * side < 0) return -1.0;
                            return std::min((p - frame.origin).dot(frame.axis) - end, parts->sleeve_over_torso(p));
                          }});
  }
  const double slant = 0.02 * (2 * uniform(seed, stream_of("shirt hem"), 0) - 1);
  shape.cuts.push_back({"hem", [=](const Vector3d& p) {
                          const double edge = parts->hem_y + slant * p.x() + (parts->spec.hem_slant - 0.05) * p.z();
                          return std::min(edge - p.y(), -parts->sleeve_over_torso(p));
                        }});
}

// `draw`: by how much a rib along the neck draws it in.
Fullness shirt_fullness(const Parts& parts, double draw, const Level& beyond_neck) {
  return [=](const Vector3d& p) -> Eigen::Matrix3d {
    const double rib = std::clamp(1 + beyond_neck(p) / kRib, 0.0, 1.0);
    if (rib > 0) return (1 - draw * rib) * Eigen::Matrix3d::Identity();
    if (parts->sleeve_over_torso(p) < 0) {
      Eigen::Matrix3d cloth = wider_round(Vector3d::UnitY(), parts->wider(p.y()));
      cloth(1, 1) += parts->longer(p.y());
      return cloth;
    }
    // A sleeve is wider from below the shoulder.
    const Tube& tube = parts->sleeve(p);
    return wider_round(tube.frame().axis,
                       0.5 * parts->spec.fullness * std::clamp((tube.polar(p)[0] - 0.06) / 0.08, 0.0, 1.0));
  };
}

}  // namespace

GarmentShape shirt_shape(const GarmentSpec& spec, const Body& body, const std::vector<Garment>& inner, Seed seed) {
  if (spec.kind == "dress" && spec.length > 1)
    throw InputError("garment.length", fmt::format("found {} on a dress; expected 1 at most", spec.length));
  const Parts parts = shirt_parts(spec, body, inner);
  const Field torso = field_of(parts->torso), left = field_of(parts->left), right = field_of(parts->right);
  GarmentShape shape;
  shape.field = solid(parts, torso, left, right);
  shape.parted = solid(parts, parts->right_gap.trunk_side(parts->left_gap.trunk_side(torso)),
                       parts->left_gap.arm_side(left), parts->right_gap.arm_side(right));
  shape.box = box_of(*parts);
  cut_neck(parts, shape);
  cut_cuffs_and_hem(parts, body, seed, shape);
  if (spec.tucked)
    shape.held = [parts](const Vector3d& p) {
      return std::min(parts->landmarks.waist - 0.02 - p.y(), -parts->sleeve_over_torso(p));
    };
  // A rib draws the neckline in, where no collar is sewn to it.
  shape.fullness = shirt_fullness(parts, shape.collar ? 0 : kRibDraw, shape.cuts.front().beyond);
  // The sleeves are sewn on where they leave the torso, below the round of the shoulder.
  const auto on_sleeve = [parts](const Vector3d& p) {
    return std::min(parts->sleeve_over_torso(p), parts->sleeve(p).polar(p)[0] - 0.045);
  };
  add_shirt_panels({parts->torso, parts->left, parts->right, kBack, parts->landmarks.armpit,
                    parts->landmarks.neck + 0.05, [parts](double y) { return parts->wider(y); }, on_sleeve},
                   shape);
  if (parts->hood) add_hood_panels(*parts->hood, collar_seam(parts->landmarks, parts->torso), shape);
  return shape;
}

}  // namespace dressform
