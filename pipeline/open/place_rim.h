#pragma once
#include <vector>

#include "pipeline/open/open_scene.h"
#include "pipeline/open/openings.h"
#include "pipeline/open/rim_fit.h"
#include "pipeline/surface/surface.h"

namespace dressform {

struct PlaceRimParams {
  RimFitParams fit;
  double least_coverage = 0.2;  // part of a rim that must be seen for it to count as observed
};

struct PlacedRim {
  RimCurve curve;
  bool observed = true;
};

// The rim from the mask edges; where too little of it was seen, from the ends of the points. A waist that the top hides
// goes round the body's waist, or as high as the surface reaches.
PlacedRim place_rim(const Opening& opening, const std::vector<RimSample>& edges, const ClosedGarment& closed,
                    const OpenScene& scene, const PlaceRimParams& params);

}  // namespace dressform
