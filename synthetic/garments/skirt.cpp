#include <algorithm>
#include <cmath>

#include "scenes/random.h"
#include "synthetic/garments/creases.h"
#include "synthetic/garments/garment_shape.h"
#include "synthetic/garments/limb_outlines.h"

namespace dressform {
namespace {

constexpr double kClearance = 0.005;

// Flutes along the skirt that grow towards the hem: a few waves of uneven width.
double flute_height(double angle, Seed seed) {
  const std::uint64_t stream = stream_of("skirt flutes");
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const auto u = uniform4(seed, stream, k);
    const int waves = 5 + 3 * k + static_cast<int>(u[1] * 2);
    sum += (k == 0 ? 0.55 : 0.4) * std::sin(waves * angle + 2 * M_PI * u[0] + 0.7 * std::sin(angle + 6 * u[2]));
  }
  return sum;
}

ClothRows skirt_rows(const GarmentSpec& spec, const Body& body, const std::vector<Garment>& inner, double hem_y,
                     Seed seed) {
  const BodyLandmarks& m = body.landmarks;
  const ClothRows taut = taut_rows(torso_frame(), hem_y - 0.04, m.waist + 0.06, trunk_outline(body, inner, 0.002),
                                   [](double) { return Vector2d(-0.01, 0); });
  const ClothRows least = grown(taut, kClearance);
  const ClothRows hung = smoothed(span_hollows(taut, 0.35, 0.0), 0.015, 0.06);
  const double ease = spec.ease_m - (row_girth(hung, hung.row_of(m.hip)) - tape_girth(body.mesh, m.hip));
  const std::vector<Crease> creases = draw_creases({{m.hip - 0.06, m.waist - 0.06, 0.5, 0.9, 0.12, 0.016, 0.6, 12}},
                                                   spec.fold_amplitude_m, seed, stream_of("skirt creases"));
  const auto height = [&](double s, double angle) {
    const double below_waist = std::clamp((m.waist - 0.01 - s) / (m.waist - m.hip), 0.0, 1.0);
    const double below_hip = std::max(0.0, m.hip - s);
    const double flare = 0.07 * below_hip, flutes = std::min(1.0, below_hip / 0.35);
    return std::max(0.0, (0.4 + 0.6 * below_waist) * ease / (2 * M_PI)) + flare +
           below_waist * crease_height(creases, s, angle, 0.15) +
           1.8 * spec.fold_amplitude_m * flutes * flute_height(angle, seed);
  };
  return no_smaller(displaced(hung, height), least, 0.006);
}

}  // namespace

GarmentShape skirt_shape(const GarmentSpec& spec, const Body& body, const std::vector<Garment>& inner, Seed seed) {
  const BodyLandmarks& m = body.landmarks;
  const double waist_y = m.waist - 0.012;
  const double hem_y = waist_y - std::clamp(spec.length, 0.25, 1.0) * (waist_y - m.ankle);
  const Tube tube = skirt_rows(spec, body, inner, hem_y, seed).tube();
  GarmentShape shape;
  shape.field = [tube](const Vector3d& p) { return tube.field(p); };
  const double reach = tube.largest_radius() + 0.03;
  shape.box = {Vector3d(-reach, tube.s_min() - 0.01, -reach - 0.02), Vector3d(reach, tube.s_max() + 0.01, reach)};
  shape.cuts.push_back({"waist", [=](const Vector3d& p) { return p.y() - (waist_y - 0.06 * p.z()); }});
  const double slant = 0.03 * (2 * uniform(seed, stream_of("skirt hem"), 0) - 1);
  shape.cuts.push_back({"hem", [=](const Vector3d& p) { return hem_y + slant * p.x() - p.y(); }});
  const ArcLength arc(tube);
  shape.pieces.push_back({[=](const Vector3d& p, const Vector3d& near) {
                            const Vector3d at = tube.polar(p);
                            const double angle = angle_near(at[1], angle_near(tube.polar(near)[1], 0));
                            return Vector2d(arc.at(p.y(), angle), waist_y + 0.03 - p.y());
                          },
                          true});
  shape.piece_of = [](const Vector3d&) { return 0; };
  return shape;
}

}  // namespace dressform
