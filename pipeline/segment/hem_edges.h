#pragma once
#include <opencv2/core/mat.hpp>
#include <vector>

#include "pipeline/segment/trunk_grid.h"
#include "pipeline/segment/view_evidence.h"

namespace dressform {

// Where one cloth may hang over another of the same colours: nats for trace_hem whose best curve runs where the upper
// cloth stands off further than the lower one and a line of shade or seam shows, between two heights over the floor.
// told: by view, uint8: the pixels that may speak.
cv::Mat edge_nats(const std::vector<ViewEvidence>& views, const std::vector<cv::Mat>& told, const TrunkGrid& grid,
                  double lowest_y, double highest_y);

}  // namespace dressform
