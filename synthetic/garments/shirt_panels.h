#pragma once
#include <functional>

#include "synthetic/garments/garment_shape.h"
#include "synthetic/garments/tube.h"

namespace dressform {

// The pieces of a shirt, cut out flat: front and back, each measured from its own middle, joined at the sides and on
// the shoulders, and two sleeves.
struct ShirtPattern {
  Tube torso, left, right;
  double back_z;                          // of the side seams
  double armpit_y, top_y;                 // of the trunk
  std::function<double(double y)> wider;  // part by which the trunk is cut wider than it lies
  Level sleeve;                           // positive on the sleeves
};

// Appends pieces, seams and piece_of.
void add_shirt_panels(const ShirtPattern& pattern, GarmentShape& shape);

}  // namespace dressform
