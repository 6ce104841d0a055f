#pragma once
#include <vector>

#include "synthetic/body/body.h"
#include "synthetic/garments/cloth_rows.h"
#include "synthetic/garments/garment.h"

namespace dressform {

// What cloth goes round, as outlines in a tube's own (u, v). All frames run "up" the image of the cloth: v = up x u,
// so that seen from outside growing angles go to the right.

// Upright about the body's axis: u forwards (+z), v to the body's left (+x), s = height.
Tube::Frame torso_frame();
// Upright about one leg: u to the outside of that leg; side +1 left, -1 right.
Tube::Frame leg_frame(const Body& body, double side);
// Down the arm from the shoulder (s = 0) to the wrist, u to the outside.
Tube::Frame arm_frame(const Body& body, double side);
double arm_length(const Body& body, double side);  // shoulder to wrist

// What a waistband at `waist_y` goes round: the outline, and above the waistband what there is at its height, so that
// cloth that hangs over it does not count.
Outline below_waistband(const Outline& outline, double waist_y);

// Trunk (with both legs below the crotch) at a height; arms left out by cutting at the shoulder joints. `inner`
// garments are gone round as well, at `gap_m`.
Outline trunk_outline(const Body& body, const std::vector<Garment>& inner, double gap_m);
Outline leg_outline(const Body& body, double side);
Outline arm_outline(const Body& body, double side);

}  // namespace dressform
