#pragma once
#include "pipeline/body/body_limbs.h"

namespace dressform {

// Front-to-back extent of a section where it crosses the line at `offset` (m) to the left of its centroid; 0 beside it.
double section_depth(const SectionLoop& loop, const BodyLimbs& limbs, double offset);

// Whether a trunk's section is two thighs that only touch: much less deep in the middle than to either side.
bool thighs_that_touch(const SectionLoop& loop, const BodyLimbs& limbs, double stature);

constexpr double kHighestCrotch = 0.53;  // of the stature (ANSUR II: mean .482, deviation .015)

}  // namespace dressform
