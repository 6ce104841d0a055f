#pragma once
#include "synthetic/body/body.h"
#include "synthetic/garments/clip.h"

namespace dressform {

// The neck's opening, positive where there is no cloth: seen from the front half an ellipse ("round") or a wedge with a
// soft point ("v"), GarmentSpec::neck_depth_m deep; at the back always round and shallow. Metres near the rim.
Level neckline(const GarmentSpec& spec, const BodyLandmarks& landmarks);

}  // namespace dressform
