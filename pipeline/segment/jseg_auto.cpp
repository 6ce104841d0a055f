#include <opencv2/imgproc.hpp>

#include "pipeline/segment/jseg_naming.h"
#include "pipeline/segment/jseg_views.h"
#include "pipeline/segment/labelled_views.h"
#include "pipeline/segment/segment.h"

namespace dressform {
namespace {

struct JsegAutoParams {
  JsegParams regions;
  FactParams facts;
  NamingParams naming;
  int closing_px = 3;
};
template <class V>
void fields(V& v, JsegAutoParams& p) {
  fields(v, p.regions);
  v("skin_mm", p.naming.skin_mm, 1, 50, "mm", "off the naked body: regions within it and of its colour are skin");
  v("skin_color", p.naming.skin_color, 1, 100, "",
    "L*u*v* distance from head, hands and feet within which a region is of skin's colour, where no naked shot tells");
  v("unchanged_part", p.naming.unchanged_part, 0, 1, "", "of a region of skin that shows the naked shot's colours");
  v("same_color", p.naming.same_color, 0, 100, "", "L*u*v* distance within which clothes that touch are one");
  v("chest_part", p.naming.chest_part, 0, 1, "",
    "of cloth on chest and upper arms that makes it top, however low it hangs");
  v("artefact_part", p.naming.artefact_part, 0, 0.1, "",
    "of all that is seen: smaller pieces by themselves are artefacts");
  v("fringe_part", p.naming.fringe_part, 0, 1, "",
    "of a small region beside a jump of depth that makes it an artefact");
  v("fringe_px", p.facts.fringe_px, 0, 20, "px", "from a jump of depth: beside it");
  v("jump_mm", p.facts.jump_mm, 5, 500, "mm", "step between neighbouring pixels that is a jump");
  v("voxel_m", p.facts.voxel_m, 0.005, 0.2, "m", "regions of two views that share such a cube touch");
  v("least_mm2", p.naming.least_mm2, 0, 1e6, "mm^2", "cloth below which there is no such garment");
  v("closing_px", p.closing_px, 1, 15, "px", "width of the square that closes the garments' masks; 1: none");
}

std::vector<cv::Mat> colors_of(const CaptureSession& session, const std::vector<ViewEvidence>& views) {
  std::vector<cv::Mat> luv(views.size());
  for (std::size_t k = 0; k < views.size(); ++k)
    if (!views[k].box.empty()) luv[k] = luv_of(session.dressed.at(session.sensors[k]).color(views[k].box));
  return luv;
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

// The regions of JSEG in every view, named by what is known of the naked body: nobody's hand is needed.
Segmentation jseg_auto(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                       const ExtractedViews& extracted, const Registration& registration,
                       const JsegAutoParams& params) {
  require_known(naked, "segment.jseg_auto");
  const NakedBody body(naked);
  const auto views = gather_views(session, calibration, body, extracted, registration, {});
  const auto maps = jseg_views(session, views, params.regions);
  const auto regions = region_facts(views, maps, colors_of(session, views), body.limbs, params.facts);
  const auto names = region_names(regions, body.limbs, params.naming);
  const TopBottom parted = masks_of(views, maps, regions, names, params.closing_px);
  return labelled_views(session, calibration, body, views, parted);
}

const Segment::Variant jseg_auto_variant{"jseg_auto", jseg_auto};

}  // namespace
}  // namespace dressform
