#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "pipeline/geometry/lattice.h"
#include "pipeline/imaging/depth_view.h"

namespace dressform {

// A garment's depth in one view, and how far each pixel is to be believed.
struct ClothDepth {
  const DepthView* view = nullptr;
  cv::Mat depth_mm;  // float32, smoothed within the cloth, 0 = none
  cv::Mat weight;    // float32: cosine between surface and line of sight; 0 beside jumps and at the cloth's end
};

struct TruncationParams {
  double truncation_m = 0.02;   // farther distances count as this
  double see_through_m = 0.03;  // a point this far in front of what a view's pixel sees is empty
  double jump_mm = 25;          // neighbouring depth pixels that differ by more are not one surface
  double range_mm = 10;         // of the bilateral filter, in depth; 0: depth as it is
  double space_px = 1.5;        // of the bilateral filter, in the image
};

// The depth of a garment (float32 mm on the view's infrared grid, raw pixels, 0 = none) with its weights.
ClothDepth cloth_depth(const DepthView& view, const cv::Mat& depth_mm, const TruncationParams& params);

// Signed distances (m, negative inside) along the lines of sight, truncated and averaged over the views by weight
// (Curless and Levoy, SIGGRAPH 1996). What no view says anything of is inside where some view has the garment in front
// of it, and outside elsewhere; what some view looks through is outside: their space carving, which closes holes.
std::vector<float> truncated_distances(const Lattice& lattice, const std::vector<ClothDepth>& cloth,
                                       const TruncationParams& params);

}  // namespace dressform
