#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "pipeline/segment/top_bottom.h"
#include "pipeline/segment/trunk_grid.h"

namespace dressform {

// The cloth of all views, and where on the body it lies.
struct ClothViews {
  const std::vector<ViewEvidence>& views;
  const std::vector<cv::Mat>& cloth;  // uint8 at the size of each view's crop
  const Landmarks& landmarks;
  TrunkGrid grid;
};

// Where top and bottom meet, in all views together.
struct HemBoundary {
  std::vector<int> rows;      // per direction of the grid, the first row that is top
  std::vector<cv::Mat> nats;  // by view, float32 at the size of the crop: what a pixel's colour says for top
};

// Two garments where a curve is found on whose sides the colours differ, or where the cloth goes round each leg: then
// the curve runs where the top's edge shows, and colours say nothing. Absent where the cloth is one garment.
// `zones`: of cloth_zones.
std::optional<HemBoundary> find_hem_boundary(const ClothViews& all, const std::vector<cv::Mat>& zones,
                                             const TopBottomParams& params);

}  // namespace dressform
