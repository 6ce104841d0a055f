#include <algorithm>
#include <cmath>
#include <functional>

#include "scenes/random.h"
#include "synthetic/garments/garment_shape.h"
#include "synthetic/garments/limb_outlines.h"

namespace dressform {
namespace {

constexpr double kClearance = 0.005;
constexpr double kBreak = 0.24;  // above the hem, what trousers are too long by falls in folds, m

ClothRows trousers_seat(const GarmentSpec& spec, const Body& body, const std::vector<Garment>& inner) {
  const BodyLandmarks& m = body.landmarks;
  const Outline trunk = trunk_outline(body, inner, 0.002);
  const ClothRows taut = taut_rows(torso_frame(), m.crotch - 0.012, m.waist + 0.06 + std::max(0.0, spec.waist_offset_m),
                                   trunk_outline(body, inner, 0.002), [](double) { return Vector2d(-0.01, 0); });
  const ClothRows least = grown(taut, kClearance);
  const ClothRows hung = smoothed(span_hollows(taut, 0.35, 0.12), 0.012, 0.06);
  const int hip = hung.row_of(m.hip);
  const double asked = (tape_girth(body.mesh, m.hip) + spec.ease_m) / (1 + spec.fullness);
  const double ease = std::max(0.0, asked - row_girth(hung, hip));
  // The waistband sits close; the ease is reached at the hips.
  const auto ease_at = [&](double s) {
    const double t = std::clamp((m.waist - 0.01 - s) / (m.waist - m.hip), 0.0, 1.0);
    return (0.4 + 0.6 * t) * ease / (2 * M_PI);
  };
  const ClothRows eased = displaced(hung, [&](double s, double) { return ease_at(s); });
  return no_smaller(eased, least, 0.005);
}

ClothRows trouser_leg(const GarmentSpec& spec, const Body& body, double side, double hem_y) {
  const BodyLandmarks& m = body.landmarks;
  const Tube::Frame frame = leg_frame(body, side);
  const Outline outline = leg_outline(body, side);
  const auto center = [&](double y) {
    const std::vector<Vector2d> points = outline(std::min(y, m.crotch - 0.01));
    Vector2d sum(0, 0);
    for (const Vector2d& p : points) sum += p;
    return points.empty() ? Vector2d(0, 0) : Vector2d(sum / points.size());
  };
  const Vector2d low = center(hem_y), high = center(m.crotch - 0.02);
  const double low_y = hem_y - 0.035, high_y = m.crotch + 0.05;
  const ClothRows taut = taut_rows(frame, low_y, high_y, outline, [=](double y) {
    const double t = std::clamp((y - hem_y) / (m.crotch - 0.02 - hem_y), 0.0, 1.0);
    return Vector2d(low + t * (high - low));
  });
  const ClothRows least = grown(taut, kClearance);
  // Falls from the thigh almost straight, a little narrower to the ankle.
  const ClothRows hung = smoothed(span_hollows(taut, 0.30, 0.068), 0.015, 0.08);
  const double ease = 0.003 + 0.7 * spec.ease_m / (2 * M_PI);
  // Between the thighs there is no room for ease or folds.
  const auto height = [&](double s, double angle) {
    const double t = std::clamp((m.crotch - s - 0.03) / 0.22, 0.0, 1.0), inner_side = 0.5 - 0.5 * std::cos(angle);
    const double room = 1 - (1 - t) * inner_side * inner_side;
    return room * ease;
  };
  return no_smaller(displaced(hung, height), least, 0.004);
}

// One leg with its half of the seat, cut out flat. `wider`: part by which it is cut wider than it lies, by height.
ClothPiece leg_piece(const Tube& leg, const Tube& seat, double side, double crotch, double waist_y,
                     const std::function<double(double y)>& wider) {
  const ArcLength leg_arc(leg), seat_arc(seat);
  // Across, both are measured from the outer seam: the seat's own zero is the front.
  const double seat_side = side * M_PI / 2;
  return {[=](const Vector3d& p, const Vector3d& near) {
            const Vector3d on_leg = leg.polar(p), on_seat = seat.polar(p);
            const double leg_angle = angle_near(on_leg[1], angle_near(leg.polar(near)[1], 0));
            const double seat_angle = angle_near(on_seat[1], seat_side);
            const double u_leg = leg_arc.at(std::min(p.y(), crotch), leg_angle);
            const double y = std::max(p.y(), crotch);
            const double u_seat = seat_arc.at(y, seat_angle) - seat_arc.at(y, seat_side);
            double t = std::clamp((p.y() - crotch + 0.03) / 0.07, 0.0, 1.0);
            t = t * t * (3 - 2 * t);
            return Vector2d((1 + wider(p.y())) * (u_leg + t * (u_seat - u_leg)), waist_y + 0.03 - p.y());
          },
          false, false};
}

}  // namespace

GarmentShape trousers_shape(const GarmentSpec& spec, const Body& body, const std::vector<Garment>& inner, Seed seed) {
  const BodyLandmarks& m = body.landmarks;
  const double waist_y = m.waist - 0.015 + spec.waist_offset_m, ankle_y = std::max(m.ankle, 0.03);
  // The shortest legs are 7 cm long: above that they are still one with the seat.
  const double asked_y = waist_y - std::clamp(spec.length, 0.25, 1.0) * (waist_y - ankle_y);
  // The cloth grows a little longer as it hangs.
  const double hem_y = std::min(asked_y + 0.009 * (waist_y - asked_y), m.crotch - 0.07);
  const Tube seat = trousers_seat(spec, body, inner).tube();
  const Tube left = trouser_leg(spec, body, 1, hem_y).tube();
  const Tube right = trouser_leg(spec, body, -1, hem_y).tube();

  GarmentShape shape;
  // Each leg stays on its own side of the middle, further off the further below the crotch.
  const double middle = 0.5 * (leg_frame(body, 1).origin.x() + leg_frame(body, -1).origin.x()), crotch = m.crotch;
  shape.field = [seat, left, right, middle, crotch](const Vector3d& p) {
    const double off_middle = 0.001 + 0.006 * std::clamp((crotch - 0.01 - p.y()) / 0.06, 0.0, 1.0);
    const double left_leg = smooth_intersection(left.field(p), off_middle - (p.x() - middle), 0.004);
    const double right_leg = smooth_intersection(right.field(p), off_middle + (p.x() - middle), 0.004);
    return smooth_union(seat.field(p), std::min(left_leg, right_leg), 0.02);
  };
  shape.box = {Vector3d(-0.45, left.s_min() - 0.01, -0.40), Vector3d(0.45, seat.s_max() + 0.01, 0.40)};

  const double waist_slant = 0.10;  // the waistband is higher at the back
  shape.cuts.push_back({"waist", [=](const Vector3d& p) { return p.y() - (waist_y - waist_slant * p.z()); }});
  for (const double side : {1.0, -1.0}) {
    const double tilt = 0.06 + 0.04 * uniform(seed, stream_of("trouser hem"), side > 0 ? 0 : 1);
    const double z = leg_frame(body, side).origin.z();
    shape.cuts.push_back({side > 0 ? "left_ankle" : "right_ankle", [=](const Vector3d& p) {
                            return p.x() * side < 0 ? -1.0 : hem_y + (tilt + spec.hem_slant) * (p.z() - z) - p.y();
                          }});
  }

  // Legs longer than the wearer's are put on shorter than they are cut, and then fall on the foot.
  const double too_long = std::max(0.0, spec.length - 1) * (waist_y - ankle_y);
  const auto longer = [=](double y) {
    return too_long / kBreak * std::clamp((hem_y + kBreak - y) / (0.5 * kBreak), 0.0, 1.0) / 0.75;
  };
  const auto wider = [=](double y) {
    const double leg = 1 - 0.5 * std::clamp((m.knee + 0.10 - y) / 0.20, 0.0, 1.0);  // less below the knee
    return leg * spec.fullness * std::clamp((waist_y - 0.03 - y) / 0.10, 0.0, 1.0);
  };
  shape.fullness = [=](const Vector3d& p) {
    Eigen::Matrix3d cloth = wider_round(Vector3d::UnitY(), wider(p.y()));
    cloth(1, 1) += longer(p.y());
    return cloth;
  };
  shape.held = [=](const Vector3d& p) { return p.y() - (waist_y - waist_slant * p.z() - 0.03); };
  for (const double side : {1.0, -1.0})
    shape.pieces.push_back(leg_piece(side > 0 ? left : right, seat, side, crotch, waist_y, wider));
  shape.seams.push_back([](const Vector3d& p) { return p.x(); });
  shape.piece_of = [](const Vector3d& p) { return p.x() > 0 ? 0 : 1; };
  return shape;
}

}  // namespace dressform
