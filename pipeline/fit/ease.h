#pragma once
#include <vector>

#include "pipeline/body/standing_body.h"

namespace dressform {

// The garment's vertices moved level by level, straight away from the trunk's axis, until the tape girth of cloth minus
// that of the body is on the user what it is on the naked body at the same part of the way between the landmarks
// (crotch, hip, waist, chest, armpit). The trunk's cloth is what closes round the trunk alone, or lies nearer to it
// than to an arm where a sleeve is one with it. Only where the cloth goes round the trunk; sleeves and legs, and levels
// that it does not close round, stay. The change fades over 3 cm of height and is at most `largest_m` in radius a
// round; girths are measured again in every round. `weights`: per vertex, 1 on the trunk, 0 on sleeves.
std::vector<Vector3d> with_ease_kept(const Mesh& before, const StandingBody& naked, const Mesh& fitted,
                                     const StandingBody& user, const std::vector<double>& weights, double largest_m,
                                     int rounds);

}  // namespace dressform
