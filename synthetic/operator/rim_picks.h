#pragma once
#include <map>
#include <string>
#include <vector>

#include "scenes/picks.h"
#include "synthetic/garments/garment.h"
#include "synthetic/operator/clicks.h"

namespace dressform {

using WornGarments = std::map<std::string, const Garment*>;  // by slot: "top", "bottom"

// Where a garment's cloth passes out of sight under another one: the operator opens the one beneath there.
struct Seam {
  std::string rim;               // of the garment that is hidden: "waist" or "hem"
  std::vector<Vector3d> points;  // world frame, closed
};

// Picks along the rims of the clothes, in the frames of sensors: 247 points on a top, 162 on a bottom (thesis, section
// 3.4.2). Where no sensor sees a rim the operator goes on in an arc; a waist or hem that is hidden by the other garment
// is picked where that one's rim hides it. Rims of which hardly anything is seen are left out. `seams`, by slot,
// receives those that lie under another garment.
void pick_rims(const WornGarments& worn, const Onlookers& eyes, Picks& picks, std::map<std::string, Seam>& seams);

}  // namespace dressform
