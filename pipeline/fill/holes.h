#pragma once
#include <opencv2/core/mat.hpp>

#include "pipeline/fill/garment_depth.h"
#include "pipeline/geometry/mesh_query.h"

namespace dressform {

struct HoleParams {
  double nearer_mm = 30;  // what hides a garment is at least this much nearer than it
  int bridge_px = 2;      // pixels without depth that a hole's row may run across
  int least_px = 20;      // smaller holes are left alone
  int side_px = 3;        // garment on either side of the hole, in its row
};

// The naked body parted in arms and the rest, model frame. `arms` may be empty.
struct PartedBody {
  MeshQuery trunk, arms;
};

// Depth of a garment where something in front hides it between two seen parts: float32 on the IR grid, 0 elsewhere.
// A hole is a run of pixels of another label with the garment on both sides of its row. Its depth is a membrane
// (Laplace's equation) over the gap between garment and limbless body, so that the body's roundness carries over;
// where the membrane is not at least `nearer_mm` behind what was measured, nothing is filled. A sleeve beside the hole
// is no part of the membrane: what is nearer to the arms than to the trunk is left out.
cv::Mat hidden_depth(const LabelledShot& shot, Label label, const cv::Mat& seen_mm, const Camera& ir,
                     const Isometry3d& model_from_sensor, const PartedBody& body, const HoleParams& params);

// Solves Laplace's equation where domain != 0; `values` (float32) is fixed elsewhere where known != 0, and where
// neither holds the edge is free. Returns the values with the domain filled in.
cv::Mat membrane(const cv::Mat& values, const cv::Mat& known, const cv::Mat& domain);

}  // namespace dressform
