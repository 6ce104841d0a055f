#pragma once
#include <vector>

namespace dressform {

// A point of a rim in the coordinates of its opening.
struct RimSample {
  double angle = 0;  // radians
  double along = 0;  // metres
  double weight = 1;
  int view = -1;  // the sensor that saw it, in CaptureSession::sensors; -1: none in particular
};

// A closed curve along(angle): a periodic spline on evenly spaced knots.
struct RimCurve {
  std::vector<double> knots;  // values at angle = -pi + 2 pi i / size
  std::vector<char> covered;  // which parts of the turn, evenly from -pi on, have samples close to the curve
  double coverage = 0;        // part of the turn that has
  double residual_rms_m = 0;  // of the samples that count
  int inliers = 0;

  double at(double angle) const;
  // Whether the angle lies in a stretch of the turn that no sample shows: gaps of less than 30 degrees are only thin.
  bool unseen(double angle) const;
};

struct RimFitParams {
  int knots = 72;
  double smoothness = 1.0;  // weight of the second differences of what it is off the best path, against the samples
  double flatness = 0.05;   // weight of what it is off the path itself
  double scale_m = 0.004;   // of the robust weights (Tukey)
  double bend_price = 150;  // of the path that the curve starts as: see rim_path.h
  int rounds = 4;
};

// Where knot `knot` of `count` round an opening stands, radians.
double rim_knot_angle(int knot, int count);

// Weight, 0 to 1, of a residual in robust fits: Tukey's biweight, 0 from 4.685 scales on.
double tukey_weight(double residual, double scale);

// A flat cut through a tube: along = middle + tilt_cos cos(angle) + tilt_sin sin(angle).
struct FlatCut {
  double middle = 0, tilt_cos = 0, tilt_sin = 0;
  double at(double angle) const;
};

// The flat cut that samples from the largest part of the turn agree with, however many strays a part has: every 15
// degrees have one vote (RANSAC with fixed random numbers, refined by least squares). Where few parts have samples the
// tilt stays small.
FlatCut fit_flat_cut(const std::vector<RimSample>& samples, double scale_m);

// Robust fit: starts as the best path of all (rim_path.h), and follows the samples near it by iteratively reweighted
// least squares with Tukey's weights; so kinks stay, strays have no say, and what no sample shows is the path's.
// No samples: no knots.
RimCurve fit_rim(const std::vector<RimSample>& samples, const RimFitParams& params);

}  // namespace dressform
