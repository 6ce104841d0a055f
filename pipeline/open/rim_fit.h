#pragma once
#include <vector>

namespace dressform {

// A point of a rim in the coordinates of its opening.
struct RimSample {
  double angle = 0;  // radians
  double along = 0;  // metres
  double weight = 1;
};

// A closed curve along(angle): a periodic spline on evenly spaced knots.
struct RimCurve {
  std::vector<double> knots;  // values at angle = -pi + 2 pi i / size
  double coverage = 0;        // part of the angles that have samples close to the curve
  double residual_rms_m = 0;  // of the samples that count
  int inliers = 0;

  double at(double angle) const;
};

struct RimFitParams {
  int knots = 72;
  double smoothness = 0.3;        // weight of the curve's second differences against the samples, in the last round
  double flatness = 0.05;         // weight of its deviation from the flat cut
  double first_smoothness = 3e3;  // in the first round: next to a tilted circle
  double first_scale_m = 0.04;    // Tukey's scale at the start ...
  double last_scale_m = 0.008;    // ... and at the end
  int rounds = 12;
};

// A flat cut through a tube: along = middle + tilt_cos cos(angle) + tilt_sin sin(angle).
struct FlatCut {
  double middle = 0, tilt_cos = 0, tilt_sin = 0;
  double at(double angle) const;
};

// The flat cut that samples from the largest part of the turn agree with, however many strays a part has: every 15
// degrees have one vote (RANSAC with fixed random numbers, refined by least squares). Where few parts have samples the
// tilt stays small.
FlatCut fit_flat_cut(const std::vector<RimSample>& samples, double scale_m);

// Robust fit by iteratively reweighted least squares: Tukey's weights. The curve starts as the flat cut, as most rims
// are; from round to round the weights' scale shrinks and the curve softens, so that a stray group of samples has lost
// its weight before the curve could bend to it. Angles without samples go back to the flat cut. No samples: no knots.
RimCurve fit_rim(const std::vector<RimSample>& samples, const RimFitParams& params);

}  // namespace dressform
