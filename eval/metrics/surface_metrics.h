#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "eval/metrics/mesh_distance.h"
#include "scenes/mesh.h"

namespace dressform::metrics {

// How an estimated surface S compares with the true one G. Distances are from points to triangles, over area-weighted
// seeded samples. Truth that no sensor saw is a class of its own (as in ETH3D): it is not asked of the estimate, and an
// estimated point whose nearest truth is of that class is judged neither right nor wrong, unless observed truth lies
// within the threshold.
struct SurfaceComparison {
  std::map<int, double> precision, recall, f;                    // by threshold, mm
  double accuracy_mm = 0, accuracy_median_mm = 0;                // S -> G, judged points
  double completeness_mm = 0, completeness_median_mm = 0;        // observed G -> S
  double chamfer_l1_mm = 0;                                      // (accuracy + completeness) / 2
  double hausdorff_mm = 0, hd95_mm = 0;                          // the larger of both directions
  double normal_consistency = 0, normal_consistency_signed = 0;  // mean |n.n'| and n.n' at the judged points of S
  double unobserved_part = 0;                                    // of the true area
  double estimate_unjudged_part = 0;                             // of the estimated area
  long estimate_samples = 0, truth_samples = 0;
};

struct SurfaceComparisonOptions {
  double spacing_m = 0.00125;  // a quarter of 5 mm
  std::vector<int> thresholds_mm{2, 5, 10};
  std::uint64_t seed = 1;
};

// `views`: per vertex of the truth, how many sensors see it; empty: all of it counts as observed. A sample takes the
// class of its nearest corner. Throws std::invalid_argument when either mesh has no area.
SurfaceComparison compare_surfaces(const Mesh& estimate, const Mesh& truth, const std::vector<std::uint8_t>& views = {},
                                   const SurfaceComparisonOptions& options = {});

// F = 2 P R / (P + R); 0 where both are 0.
double f_score(double precision, double recall);

}  // namespace dressform::metrics
