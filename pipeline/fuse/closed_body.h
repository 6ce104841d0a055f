#pragma once
#include "pipeline/fuse/free_space.h"
#include "scenes/mesh.h"

namespace dressform {

struct ClosedBodyOptions {
  int poisson_depth = 8;
  FreeSpaceOptions free_space;
  double thigh_gap_m = 0.012;
  bool cut_ends = false;  // take head, neck, hands and feet off (body_ends.h)
};

// Closed, outward, one piece without handles: Poisson surface of the body's points (model frame) and of the soles under
// them, less what the scan saw to be empty, and thighs apart (thigh_gap.h). Where something is taken out, or the
// surface is no ball, the ball-shaped solid nearest to it. Empty for no points.
Mesh closed_body(const PointCloud& body, const ClosedBodyOptions& options, const ScanViews& views);

}  // namespace dressform
