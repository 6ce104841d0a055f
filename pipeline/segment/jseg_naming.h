#pragma once
#include <vector>

#include "pipeline/segment/jseg_facts.h"
#include "scenes/label.h"

namespace dressform {

struct NamingParams {
  double skin_mm = 8;            // of the naked body: within it, and of its colour, a region is skin
  double skin_color = 20;        // L*u*v* distance from head, hands and feet, where no naked shot tells
  double unchanged_part = 0.5;   // of a region that shows the naked shot's colours
  double same_color = 16;        // L*u*v* distance of clothes that are one
  double chest_part = 0.25;      // of cloth on chest and upper arms: more of it is top, however low it hangs
  double artefact_part = 0.005;  // of all that is seen: smaller pieces by themselves are artefacts
  double fringe_part = 0.5;      // of a small region beside a jump of depth: an artefact
  double least_mm2 = 6000;       // of cloth, below which there is no such garment
};

// The name of every region: skin by the naked body, then clothes by colour, place and height.
std::vector<Label> region_names(const std::vector<RegionFacts>& regions, const Landmarks& limbs,
                                const NamingParams& params);

}  // namespace dressform
