#include <algorithm>
#include <cmath>

#include "fmt/format.h"
#include "scenes/error.h"
#include "scenes/random.h"
#include "synthetic/garments/garment_shape.h"
#include "synthetic/garments/limb_outlines.h"

namespace dressform {
namespace {

constexpr double kClearance = 0.005;

// The smooth shape that the cloth is put on as: close at the waist, wider below the hip.
ClothRows skirt_rows(const GarmentSpec& spec, const Body& body, const std::vector<Garment>& inner, double hem_y) {
  const BodyLandmarks& m = body.landmarks;
  const Outline trunk = trunk_outline(body, inner, 0.002);
  const ClothRows taut = taut_rows(torso_frame(), hem_y - 0.04, m.waist + 0.06 + std::max(0.0, spec.waist_offset_m),
                                   trunk_outline(body, inner, 0.002), [](double) { return Vector2d(-0.01, 0); });
  const ClothRows least = grown(taut, kClearance);
  const ClothRows hung = smoothed(span_hollows(taut, 0.35, 0.0), 0.015, 0.06);
  const double asked = (tape_girth(body.mesh, m.hip) + spec.ease_m) / (1 + spec.fullness);
  const double ease = std::max(0.0, asked - row_girth(hung, hung.row_of(m.hip)));
  const auto height = [&](double s, double) {
    const double below_waist = std::clamp((m.waist - 0.01 - s) / (m.waist - m.hip), 0.0, 1.0);
    return (0.4 + 0.6 * below_waist) * ease / (2 * M_PI) + 0.07 * std::max(0.0, m.hip - s);
  };
  return no_smaller(displaced(hung, height), least, 0.006);
}

}  // namespace

GarmentShape skirt_shape(const GarmentSpec& spec, const Body& body, const std::vector<Garment>& inner, Seed seed) {
  if (spec.length > 1)
    throw InputError("garment.length", fmt::format("found {} on a skirt; expected 1 at most", spec.length));
  const BodyLandmarks& m = body.landmarks;
  const double waist_y = m.waist - 0.012 + spec.waist_offset_m;
  const double hem_y = waist_y - std::clamp(spec.length, 0.25, 1.0) * (waist_y - m.ankle);
  const Tube tube = skirt_rows(spec, body, inner, hem_y).tube();
  GarmentShape shape;
  shape.field = [tube](const Vector3d& p) { return tube.field(p); };
  const double reach = tube.largest_radius() + 0.03;
  shape.box = {Vector3d(-reach, tube.s_min() - 0.01, -reach - 0.02), Vector3d(reach, tube.s_max() + 0.01, reach)};
  shape.cuts.push_back({"waist", [=](const Vector3d& p) { return p.y() - (waist_y - 0.06 * p.z()); }});
  const double slant = 0.03 * (2 * uniform(seed, stream_of("skirt hem"), 0) - 1);
  shape.cuts.push_back(
      {"hem", [=](const Vector3d& p) { return hem_y + slant * p.x() + spec.hem_slant * p.z() - p.y(); }});
  // Nothing at the waistband, the fullness at the hip, the flare at the hem.
  const auto wider = [=](double y) {
    const double seat = std::clamp((waist_y - 0.03 - y) / (waist_y - 0.03 - m.hip), 0.0, 1.0);
    const double skirt = std::clamp((m.hip + 0.05 - y) / std::max(0.1, m.hip + 0.05 - hem_y), 0.0, 1.1);
    return seat * spec.fullness + skirt * spec.flare;
  };
  shape.fullness = [=](const Vector3d& p) { return wider_round(Vector3d::UnitY(), wider(p.y())); };
  shape.held = [=](const Vector3d& p) { return p.y() - (waist_y - 0.06 * p.z() - 0.03); };
  // Two panels, each measured from its own middle, joined at the sides.
  const ArcLength arc(tube);
  for (const double middle : {0.0, M_PI})
    shape.pieces.push_back({[=](const Vector3d& p, const Vector3d&) {
                              const double angle = angle_near(tube.polar(p)[1], middle);
                              const double across = arc.at(p.y(), angle) - arc.at(p.y(), middle);
                              return Vector2d((1 + wider(p.y())) * across, waist_y + 0.03 - p.y());
                            },
                            middle == 0, true});
  const Level forward = [tube](const Vector3d& p) { return std::cos(tube.polar(p)[1]) * tube.polar(p)[2]; };
  shape.seams.push_back(forward);
  shape.piece_of = [forward](const Vector3d& p) { return forward(p) > 0 ? 0 : 1; };
  return shape;
}

}  // namespace dressform
