#pragma once
#include <vector>

#include "scenes/registry.h"

namespace dressform {

// One soft ridge on a tube of cloth: around (angle) and along (s) its middle, at `slant` from the way round.
struct Crease {
  double s = 0, angle = 0;  // middle: metres, radians
  double slant = 0;         // radians; 0 goes round the tube, pi/2 along it
  double length_m = 0.1, width_m = 0.018, height_m = 0.005;
};

// A stretch of cloth with its own kind of creases.
struct CreaseZone {
  double s_low = 0, s_high = 0;        // where their middles lie
  double slant = 0, slant_spread = 0;  // radians
  double length_m = 0.1, width_m = 0.018;
  double height = 1;  // times the garment's fold amplitude
  int count = 10;
};

// Deterministic in (seed, stream). Heights vary between 0.5 and 1.2 of the zone's, of either sign one in four negative.
std::vector<Crease> draw_creases(const std::vector<CreaseZone>& zones, double amplitude_m, Seed seed,
                                 std::uint64_t stream);

// Sum of the ridges at a place on a tube of about `radius_m`.
double crease_height(const std::vector<Crease>& creases, double s, double angle, double radius_m);

}  // namespace dressform
