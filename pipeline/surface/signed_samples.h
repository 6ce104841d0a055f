#pragma once
#include <vector>

#include "scenes/mesh.h"

namespace dressform {

// What a function must be at points for its zero to be the surface (Carr et al., SIGGRAPH 2001): zero on the points,
// and the distance, positive outside, off them along their normals.
struct SignedSamples {
  std::vector<Vector3d> points;
  std::vector<double> distances_m;
};

// On-surface samples for all points; of every `every`th also one on either side, `offset_m` away, or half, a quarter
// ... of that, so that the point it came from is its nearest one: no sample lies where another part of the surface is.
// Those that would come nearer than `nearest_m` are left out. The cloud has unit normals.
SignedSamples signed_samples(const PointCloud& cloud, double offset_m, double nearest_m, int every);

// A biharmonic function through the samples to within a tolerance, with as few centres as that takes.
struct GreedyFit {
  int first_centres = 300;
  double growth = 0.3;          // centres added in a round, over those that are there
  int most_centres = 2000;      // the system is dense
  double tolerance_m = 0.002;   // samples missed by less need no centre of their own
  double smoothing_m = 0.0005;  // of the function itself
  double apart_m = 0.01;        // two centres of one round are not taken from one cell of this size
};

// Indices of the samples that became centres: spread ones first, then in every round those that are missed most (Carr
// et al., 2001, section 4). Empty where the samples do not span space.
std::vector<std::size_t> greedy_centres(const SignedSamples& samples, const GreedyFit& fit);

}  // namespace dressform
