#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

namespace dressform {

// Where rows of a depth image step from one surface to another: two runs of pixels, each steady, no more than six
// pixels apart.
struct DepthEdges {
  double from_m = 0, to_m = 0;               // steps of this size
  long crossings = 0, flying = 0, lost = 0;  // of a contour; pixels between that have a depth of neither side, or none
};

// Steps by their size: 0.1, 0.2, 0.4, 0.8, 1.6 m and more. Adds to `edges` (empty: starts them).
void count_edges(const cv::Mat& depth_mm, std::vector<DepthEdges>& edges);

}  // namespace dressform
