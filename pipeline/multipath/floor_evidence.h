#pragma once
#include <vector>

#include "pipeline/multipath/bounce_field.h"

namespace dressform {

// What the floor of one image says about light that bounced: a floor is flat, bounced light bends it as predicted.
struct FloorEvidence {
  bool found = false;
  double factor = 0, sigma = 0;  // of the predicted errors: 1 when they are all there, 0 when there are none
  std::vector<char> is_floor;    // by cell
};

// Plane and factor together, by least squares with Tukey's weights.
FloorEvidence floor_evidence(const SurfaceCells& cells, const std::vector<float>& errors_m);

}  // namespace dressform
