#pragma once
#include <map>
#include <string>

#include "synthetic/operator/rim_picks.h"

namespace dressform {

// Picks along the lines at which the four parts of a texture meet (thesis, section 3.5), in the frames of sensors: 243
// points on a top, 271 on a bottom. `border_<slot>_front_left`, `_front_right`, `_back_left`, `_back_right` run upwards
// where the outline is half turned between two views; `_inner` of trousers runs from the left ankle up to the crotch
// and down to the right ankle. What lies under another garment (`seams`) is left out.
void pick_borders(const WornGarments& worn, const std::map<std::string, Seam>& seams, const Onlookers& eyes,
                  Picks& picks);

}  // namespace dressform
