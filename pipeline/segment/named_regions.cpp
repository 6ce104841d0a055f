#include "pipeline/segment/named_regions.h"

#include <tbb/parallel_for.h>

#include <opencv2/imgproc.hpp>

#include "pipeline/segment/jseg_colors.h"

namespace dressform {
namespace {

std::vector<cv::Mat> colors_of(const CaptureSession& session, const std::vector<ViewEvidence>& views) {
  std::vector<cv::Mat> luv(views.size());
  for (std::size_t k = 0; k < views.size(); ++k)
    if (!views[k].box.empty()) luv[k] = luv_of(session.dressed.at(session.sensors[k]).color(views[k].box));
  return luv;
}

std::vector<LabelMap> regions_of(const CaptureSession& session, const std::vector<ViewEvidence>& views,
                                 const FindRegions& find) {
  std::vector<LabelMap> maps(views.size());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t k) {
    if (views[k].box.empty()) return;
    const cv::Mat& color = session.dressed.at(session.sensors[k]).color;
    maps[k] = find(color(views[k].box), views[k].body, color.cols / 1920.0);
  });
  return maps;
}

cv::Mat closed(const cv::Mat& mask, const cv::Mat& free, int width_px) {
  cv::Mat result;
  cv::morphologyEx(mask, result, cv::MORPH_CLOSE, cv::Mat::ones(width_px, width_px, CV_8U));
  return (result & free) | mask;
}

// The masks of the regions of either garment, closed over what is neither.
TopBottom masks_of(const std::vector<ViewEvidence>& views, const std::vector<LabelMap>& maps,
                   const std::vector<RegionFacts>& regions, const std::vector<Label>& names, int closing_px) {
  TopBottom parted;
  parted.top.resize(views.size());
  parted.bottom.resize(views.size());
  std::vector<std::vector<Label>> name_of(views.size());
  for (std::size_t k = 0; k < views.size(); ++k)
    name_of[k].resize(static_cast<std::size_t>(maps[k].count) + 1, Label::none);
  for (std::size_t i = 0; i < regions.size(); ++i) name_of[regions[i].view][regions[i].label] = names[i];
  for (std::size_t k = 0; k < views.size(); ++k) {
    if (views[k].box.empty()) continue;
    cv::Mat top = cv::Mat::zeros(views[k].box.size(), CV_8U), bottom = top.clone();
    for (int v = 0; v < top.rows; ++v) {
      for (int u = 0; u < top.cols; ++u) {
        const Label name = name_of[k][maps[k].labels.at<int>(v, u)];
        if (name == Label::top) top.at<uchar>(v, u) = 255;
        if (name == Label::bottom) bottom.at<uchar>(v, u) = 255;
      }
    }
    parted.top[k] = closed(top, views[k].body & ~bottom, closing_px);
    parted.bottom[k] = closed(bottom, views[k].body & ~parted.top[k], closing_px);
    parted.has_top |= cv::countNonZero(parted.top[k]) > 0;
    parted.has_bottom |= cv::countNonZero(parted.bottom[k]) > 0;
  }
  return parted;
}

}  // namespace

Segmentation named_regions(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                           const ExtractedViews& extracted, const Registration& registration, const char* variant,
                           const FindRegions& find, const NamedRegionParams& params) {
  require_known(naked, variant);
  const NakedBody body(naked);
  const auto views = gather_views(session, calibration, body, extracted, registration, {});
  const auto maps = regions_of(session, views, find);
  const auto regions = region_facts(views, maps, colors_of(session, views), body.limbs, params.facts);
  const auto names = region_names(regions, body.limbs, params.naming);
  const TopBottom parted = masks_of(views, maps, regions, names, params.closing_px);
  return labelled_views(session, calibration, body, views, parted);
}

}  // namespace dressform
