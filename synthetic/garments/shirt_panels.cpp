#include "synthetic/garments/shirt_panels.h"

#include <algorithm>
#include <cmath>

namespace dressform {
namespace {

ClothPiece trunk_panel(const ShirtPattern& pattern, const ArcLength& arc, double middle) {
  ClothPiece piece;
  piece.place = [=](const Vector3d& p, const Vector3d&) {
    const Vector3d at = pattern.torso.polar(p);
    const double off_middle = std::remainder(at[1] - middle, 2 * M_PI), angle = middle + off_middle;
    // On the shoulder the cloth goes on outwards from the torso's side.
    const double level = std::min(at[0], pattern.armpit_y);
    const double outwards = std::max(0.0, at[2] - pattern.torso.radius(level, angle));
    const double across = arc.at(level, angle) - arc.at(level, middle);
    const double u = (1 + pattern.wider(p.y())) * across + std::copysign(outwards, off_middle);
    // Over the shoulder the cloth rolls backwards: its depth counts as length, too.
    const double w = std::clamp((p.y() - pattern.armpit_y) / 0.06, 0.0, 1.0);
    const double rise = 0.6 * w * std::max(0.0, 0.10 - std::abs(p.z() - pattern.back_z));
    return Vector2d(u, pattern.top_y - p.y() - rise);
  };
  piece.text = middle == 0;
  piece.trunk = true;
  return piece;
}

ClothPiece sleeve_panel(const Tube& tube) {
  ClothPiece piece;
  piece.place = [tube, arc = ArcLength(tube)](const Vector3d& p, const Vector3d& near) {
    const Vector3d at = tube.polar(p), about = tube.polar(near);
    const double angle = angle_near(at[1], angle_near(about[1], 0));
    return Vector2d(arc.at(at[0], angle), at[0] - tube.s_min());
  };
  return piece;
}

}  // namespace

void add_shirt_panels(const ShirtPattern& pattern, GarmentShape& shape) {
  const ArcLength arc(pattern.torso);
  for (const double middle : {0.0, M_PI}) shape.pieces.push_back(trunk_panel(pattern, arc, middle));
  shape.pieces.push_back(sleeve_panel(pattern.left));
  shape.pieces.push_back(sleeve_panel(pattern.right));
  const auto forward = [z = pattern.back_z](const Vector3d& p) { return p.z() - z; };
  shape.seams.push_back(pattern.sleeve);
  shape.seams.push_back(forward);  // side and shoulder seams
  shape.piece_of = [sleeve = pattern.sleeve, forward](const Vector3d& p) {
    if (sleeve(p) < 0) return forward(p) > 0 ? 0 : 1;
    return p.x() > 0 ? 2 : 3;
  };
}

}  // namespace dressform
