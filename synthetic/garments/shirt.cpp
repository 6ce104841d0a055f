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

}  // namespace

GarmentShape shirt_shape(const GarmentSpec& spec, const Body& body, const std::vector<Garment>& inner, Seed seed) {
  if (spec.kind == "dress" && spec.length > 1)
    throw InputError("garment.length", fmt::format("found {} on a dress; expected 1 at most", spec.length));
  const BodyLandmarks& m = body.landmarks;
  const double hem_y = hem_height(spec, m);
  const ClothRows trunk = taut_torso(body, inner, hem_y);
  const Tube torso = shirt_torso(spec, body, trunk).tube();
  const double cuff = std::clamp(spec.sleeve, 0.1, 1.0) * arm_length(body, 1);
  const double right_cuff = std::clamp(spec.sleeve, 0.1, 1.0) * arm_length(body, -1);
  const ClothRows left_arm = taut_sleeve(body, 1, cuff), right_arm = taut_sleeve(body, -1, right_cuff);
  const Tube left = shirt_sleeve(spec, left_arm).tube();
  const Tube right = shirt_sleeve(spec, right_arm).tube();
  const Underarm left_gap(trunk.tube(), left_arm.tube(), 1, cuff);
  const Underarm right_gap(trunk.tube(), right_arm.tube(), -1, right_cuff);

  const auto hood = spec.collar == "hood" ? std::make_shared<const Hood>(body, spec.neck_depth_m) : nullptr;

  GarmentShape shape;
  const auto joined = [&](const Field& trunk_cloth, const Field& left_sleeve, const Field& right_sleeve) {
    return right_gap.parted(left_gap.parted([=](const Vector3d& p) {
      const double sleeve = p.x() > 0 ? left_sleeve(p) : right_sleeve(p);
      const double shirt = smooth_union(trunk_cloth(p), sleeve, 0.028);
      return hood ? smooth_union(shirt, hood->field(p), 0.04) : shirt;
    }));
  };
  const Field torso_field = field_of(torso), left_field = field_of(left), right_field = field_of(right);
  shape.field = joined(torso_field, left_field, right_field);
  shape.parted = joined(right_gap.trunk_side(left_gap.trunk_side(torso_field)), left_gap.arm_side(left_field),
                        right_gap.arm_side(right_field));
  const double reach =
      std::max(std::abs(left.point(left.s_max(), 0, 0).x()), std::abs(right.point(right.s_max(), 0, 0).x()));
  shape.box = {
      Vector3d(
          -reach - 0.12,
          std::min({torso.s_min(), left.point(left.s_max(), 0, 0).y(), right.point(right.s_max(), 0, 0).y()}) - 0.06,
          -0.40),
      Vector3d(reach + 0.12, std::max(torso.s_max(), hood ? hood->top() : 0) + 0.02, 0.40)};

  // Positive where a place belongs to the sleeve rather than the torso: by the cloth, and beside the gap by the body.
  const auto sleeve_over_torso = [=](const Vector3d& p) {
    const double by_cloth = torso.field(p) - (p.x() > 0 ? left.field(p) : right.field(p));
    const Underarm& gap = p.x() > 0 ? left_gap : right_gap;
    if (!gap.start_y()) return by_cloth;
    const double t = std::clamp((*gap.start_y() - p.y()) / 0.02, 0.0, 1.0);
    return by_cloth + t * (gap.nearer_to_arm(p) - by_cloth);
  };
  if (hood) {
    shape.cuts.push_back({"neck", [hood](const Vector3d& p) { return hood->opening(p); }});
  } else if (spec.collar == "polo") {
    shape.collar = CollarCut{collar_seam(m, torso)};
    shape.cuts.push_back({"neck", [seam = shape.collar->seam, slit = collar_slit(m, spec.neck_depth_m)](
                                      const Vector3d& p) { return std::max(seam(p), slit(p)); }});
  } else {
    shape.cuts.push_back({"neck", neckline(spec, m)});
  }
  for (const double side : {1.0, -1.0}) {
    const Tube::Frame frame = arm_frame(body, side);
    const double end = side > 0 ? cuff : right_cuff;
    shape.cuts.push_back({side > 0 ? "left_cuff" : "right_cuff", [=](const Vector3d& p) {
                            if (p.x() * side < 0) return -1.0;
                            return std::min((p - frame.origin).dot(frame.axis) - end, sleeve_over_torso(p));
                          }});
  }
  const double slant = 0.02 * (2 * uniform(seed, stream_of("shirt hem"), 0) - 1);
  shape.cuts.push_back({"hem", [=](const Vector3d& p) {
                          const double edge = hem_y + slant * p.x() + (spec.hem_slant - 0.05) * p.z();
                          return std::min(edge - p.y(), -sleeve_over_torso(p));
                        }});

  // The trunk is wider from under the arms down, a dress most at its hem, a sleeve from below the shoulder.
  const double flare = spec.kind == "dress" ? spec.flare : 0, hip = m.hip + 0.05;
  const double loose_to = spec.tucked ? m.waist + 0.06 : -1;  // below, what is worn over it holds it smooth
  const auto wider = [=](double y) {
    if (y < loose_to) return 0.0;
    return spec.fullness * std::clamp((m.armpit + 0.02 - y) / 0.10, 0.0, 1.0) +
           flare * std::clamp((hip - y) / std::max(0.1, hip - hem_y), 0.0, 1.1);
  };
  // A tucked shirt is longer above the waist than the way it goes: it hangs over.
  const auto longer = [=](double y) {
    return spec.tucked ? kBlouse * std::max(0.0, 1 - std::abs(y - m.waist - 0.08) / 0.08) : 0.0;
  };
  if (spec.tucked)
    shape.held = [=](const Vector3d& p) { return std::min(m.waist - 0.02 - p.y(), -sleeve_over_torso(p)); };
  // A rib draws the neckline in, where no collar is sewn to it.
  const double draw = shape.collar ? 0 : kRibDraw;
  const Level beyond_neck = shape.cuts.front().beyond;
  shape.fullness = [=](const Vector3d& p) -> Eigen::Matrix3d {
    const double rib = std::clamp(1 + beyond_neck(p) / kRib, 0.0, 1.0);
    if (rib > 0) return (1 - draw * rib) * Eigen::Matrix3d::Identity();
    if (sleeve_over_torso(p) < 0) {
      Eigen::Matrix3d cloth = wider_round(Vector3d::UnitY(), wider(p.y()));
      cloth(1, 1) += longer(p.y());
      return cloth;
    }
    const Tube& tube = p.x() > 0 ? left : right;
    return wider_round(tube.frame().axis, 0.5 * spec.fullness * std::clamp((tube.polar(p)[0] - 0.06) / 0.08, 0.0, 1.0));
  };
  // The sleeves are sewn on where they leave the torso, below the round of the shoulder.
  const auto on_sleeve = [=](const Vector3d& p) {
    const double along = p.x() > 0 ? left.polar(p)[0] : right.polar(p)[0];
    return std::min(sleeve_over_torso(p), along - 0.045);
  };
  add_shirt_panels({torso, left, right, kBack, m.armpit, m.neck + 0.05, wider, on_sleeve}, shape);
  if (hood) add_hood_panels(*hood, collar_seam(m, torso), shape);
  return shape;
}

}  // namespace dressform
