#pragma once
#include <cmath>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "pipeline/segment/trunk_grid.h"
#include "pipeline/segment/view_evidence.h"

namespace dressform {

// What the place of a cloth pixel on the body says of its garment. Sleeves belong to the top.
enum Zone : uchar { kNowhere, kBetween, kSureTop, kSureBottom, kSleeve };

// Calls visit(v, u) for the cloth pixels of one view whose place is known.
template <class Visit>
void each_cloth_pixel(const ViewEvidence& view, const cv::Mat& cloth, const Visit& visit) {
  for (int v = 0; v < view.box.height; ++v)
    for (int u = 0; u < view.box.width; ++u)
      if (cloth.at<uchar>(v, u) && !std::isnan(view.place_m.at<cv::Vec3f>(v, u)[0])) visit(v, u);
}

// By view, uint8 Zone at the size of the crop: cloth on chest and upper arms is top, cloth low on the legs is bottom.
std::vector<cv::Mat> cloth_zones(const std::vector<ViewEvidence>& views, const std::vector<cv::Mat>& cloth,
                                 const Landmarks& limbs);

// The same with another bottom: in every direction the lower end of the cloth on trunk and legs, for a bottom that
// shows no more than that below the top.
std::vector<cv::Mat> with_lower_end(std::vector<cv::Mat> zones, const std::vector<ViewEvidence>& views,
                                    const std::vector<cv::Mat>& cloth, const Landmarks& limbs, const TrunkGrid& grid);

// The same less the bottom's pixels of colours that are seen above the waist, too.
std::vector<cv::Mat> without_colors_of_top(std::vector<cv::Mat> zones, const std::vector<ViewEvidence>& views,
                                           const std::vector<cv::Mat>& cloth, const Landmarks& limbs);

double zone_area_mm2(const std::vector<cv::Mat>& zones, const std::vector<ViewEvidence>& views, Zone zone);

}  // namespace dressform
