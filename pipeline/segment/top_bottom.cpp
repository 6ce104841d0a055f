#include "pipeline/segment/top_bottom.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "pipeline/imaging/graph_cut.h"
#include "pipeline/segment/cloth_zones.h"
#include "pipeline/segment/hem_boundary.h"
#include "pipeline/segment/view_models.h"

namespace dressform {
namespace {

constexpr float kHeightNats = 4;         // at the edge of the band, in favour of the curve's own side
constexpr double kColorContrast = 0.02;  // see binary_cut

// Outside the cloth, the label of the cloth nearby: its outline costs nothing.
void fade(cv::Mat& mask, const cv::Mat& inside) {
  cv::Mat grown;
  cv::dilate(mask & inside, grown, cv::Mat(), {-1, -1}, 2);
  grown.copyTo(mask, inside == 0);
}

// The curve's division of one view, moved to the edges of the image.
cv::Mat redrawn(const ClothViews& all, const cv::Mat& zones, const HemBoundary& hem, std::size_t k,
                const TopBottomParams& params) {
  const ViewEvidence& view = all.views[k];
  cv::Mat initial = cv::Mat::zeros(view.box.size(), CV_8U), active = initial.clone();
  cv::Mat cost = cv::Mat::zeros(view.box.size(), CV_32F);
  const auto band_m = static_cast<float>(params.band_mm / 1000);
  for (int v = 0; v < initial.rows; ++v) {
    for (int u = 0; u < initial.cols; ++u) {
      if (!all.cloth[k].at<uchar>(v, u)) continue;
      const auto& place = view.place_m.at<cv::Vec3f>(v, u);
      if (std::isnan(place[0])) {  // no place near: colours and neighbours alone
        active.at<uchar>(v, u) = 255;
        cost.at<float>(v, u) = -hem.nats[k].at<float>(v, u);
        continue;
      }
      const float height = all.grid.above(place, hem.rows);
      const bool sleeve = zones.at<uchar>(v, u) == kSleeve;
      if (sleeve || height > 0) initial.at<uchar>(v, u) = 255;
      if (sleeve || std::abs(height) > band_m) continue;
      active.at<uchar>(v, u) = 255;
      cost.at<float>(v, u) = -hem.nats[k].at<float>(v, u) - kHeightNats * height / band_m;
    }
  }
  fade(initial, all.cloth[k]);
  cv::Mat cut = binary_cut(view.lab, cost, active, initial, {params.smoothness, kColorContrast}) & all.cloth[k];
  remove_specks(cut, all.cloth[k], params.speck_mm2, pixel_size_mm(view));
  return cut;
}

}  // namespace

TopBottom part_cloth(const std::vector<ViewEvidence>& views, const std::vector<cv::Mat>& cloth, const Landmarks& limbs,
                     const TopBottomParams& params) {
  const ClothViews all{views, cloth, limbs, TrunkGrid(limbs)};
  const auto zones = cloth_zones(views, cloth, limbs);
  TopBottom result;
  std::optional<HemBoundary> hem;
  result.has_top = zone_area_mm2(zones, views, kSureTop) >= params.least_mm2;
  if (result.has_top) hem = find_hem_boundary(all, zones, params);
  result.has_bottom = result.has_top ? hem.has_value() : zone_area_mm2(zones, views, kSureBottom) >= params.least_mm2;
  result.top.resize(views.size());
  result.bottom.resize(views.size());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t k) {
    if (views[k].box.empty()) return;
    const cv::Mat nothing = cv::Mat::zeros(views[k].box.size(), CV_8U);
    result.top[k] = hem ? redrawn(all, zones[k], *hem, k, params) : result.has_top ? cloth[k].clone() : nothing;
    result.bottom[k] = result.has_bottom ? cv::Mat(cloth[k] & ~result.top[k]) : nothing;
  });
  return result;
}

}  // namespace dressform
