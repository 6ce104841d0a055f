#pragma once
#include "synthetic/body/body.h"
#include "synthetic/garments/clip.h"
#include "synthetic/garments/tube.h"

namespace dressform {

// The neck's opening, positive where there is no cloth: seen from the front half an ellipse ("round") or a wedge with a
// soft point ("v"), GarmentSpec::neck_depth_m deep; at the back always round and shallow. Metres near the rim.
Level neckline(const GarmentSpec& spec, const BodyLandmarks& landmarks);

// Where a collar or a hood is sewn on: round and close about the neck, whose size is taken from the cloth about the
// trunk. Positive towards the neck.
Level collar_seam(const BodyLandmarks& landmarks, const Tube& trunk);

// The slit in front below a collar, `length_m` long from the seam down, as two buttons left open. Positive inside.
Level collar_slit(const BodyLandmarks& landmarks, double length_m);

}  // namespace dressform
