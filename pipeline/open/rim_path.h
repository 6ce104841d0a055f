#pragma once
#include <vector>

#include "pipeline/open/rim_fit.h"

namespace dressform {

struct RimPathParams {
  double scale_m = 0.004;   // Tukey's scale: samples up to 4.7 times as far from the path speak for it
  double bend_price = 150;  // per change of slope, in metres a knot: a knot's samples are worth 1
  double flat_price = 1;    // per metre off the flat cut and knot
};

constexpr int kRimPathKnots = 72;
constexpr double kFullRimKnot = 3;  // weight of samples from which a knot counts in full

// The closed path round an opening that most of the samples lie on for the fewest and least steep kinks: the minimum
// over all paths on a grid (Viterbi over height and slope, round the turn three times), so that it does not depend on a
// start, and strays cannot pull it unless they reach further round than it would have to kink for them. Deep necks have
// as many kinks as a dent of strays, but many more samples. Returns `along` at angles -pi + 2 pi i / kRimPathKnots.
std::vector<double> best_rim_path(const std::vector<RimSample>& samples, const FlatCut& flat,
                                  const RimPathParams& params);

}  // namespace dressform
