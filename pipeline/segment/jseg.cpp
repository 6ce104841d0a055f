#include <algorithm>
#include <array>
#include <opencv2/core.hpp>

#include "pipeline/segment/jseg_views.h"
#include "pipeline/segment/labelled_views.h"
#include "pipeline/segment/segment.h"
#include "scenes/picks.h"

namespace dressform {
namespace {

struct JsegNamedParams {
  JsegParams regions;
};
template <class V>
void fields(V& v, JsegNamedParams& p) {
  fields(v, p.regions);
}

struct Named {
  const char* name;
  Label label;
};
constexpr std::array<Named, 3> kNames = {{{"skin", Label::skin}, {"top", Label::top}, {"bottom", Label::bottom}}};

// How many pixels of each region the operator gave each label: by region, then label.
std::vector<std::array<int, 4>> votes(const LabelMap& map, const cv::Rect& box, const Picks& picks,
                                      const std::string& sensor, const cv::Size& size) {
  std::vector<std::array<int, 4>> result(static_cast<std::size_t>(map.count) + 1, {0, 0, 0, 0});
  bool any = false;
  for (const Named& each : kNames) {
    const cv::Mat mask = picked_region(picks, std::string("label_") + each.name + "_" + sensor, size);
    if (mask.empty()) continue;
    any = true;
    const cv::Mat crop = mask(box);
    for (int v = 0; v < crop.rows; ++v)
      for (int u = 0; u < crop.cols; ++u)
        if (crop.at<uchar>(v, u)) ++result[map.labels.at<int>(v, u)][static_cast<int>(each.label)];
  }
  if (!any)
    throw InputError("picks", "found no label_*_" + sensor + "; expected label_skin_" + sensor + ", label_top_" +
                                  sensor + " or label_bottom_" + sensor +
                                  " (scenes/README.md, picks): a mask over the regions that are of it, which " +
                                  "dressform segment shows on the view's colour image");
  return result;
}

// Regions that the operator gave no label are skin.
cv::Mat of_label(const LabelMap& map, const std::vector<std::array<int, 4>>& votes, Label label) {
  cv::Mat mask = cv::Mat::zeros(map.labels.size(), CV_8U);
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      const int region = map.labels.at<int>(v, u);
      if (!region) continue;
      const auto& of = votes[region];
      const auto most = std::max_element(of.begin() + 1, of.end());
      if (*most > 0 && most - of.begin() == static_cast<int>(label)) mask.at<uchar>(v, u) = 255;
    }
  }
  return mask;
}

// What of a garment lies outside the region that the operator drew round it is an artefact, as in figures 3.8 and 3.9.
void drop_artefacts(const Picks& picks, const std::string& garment, const std::string& sensor, const cv::Rect& box,
                    const cv::Size& size, cv::Mat& mask) {
  const cv::Mat region = picked_region(picks, "region_" + garment + "_" + sensor, size);
  if (!region.empty()) mask.setTo(0, region(box) == 0);
}

// The regions of JSEG in every view, named by what the operator labelled, as in the thesis, section 3.2.1.
Segmentation jseg_named(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                        const ExtractedViews& extracted, const Registration& registration,
                        const JsegNamedParams& params, const Picks& picks) {
  require_known(naked, "segment.jseg");
  const NakedBody body(naked);
  const auto views = gather_views(session, calibration, body, extracted, registration, {});
  const auto maps = jseg_views(session, views, params.regions);
  TopBottom parted;
  parted.top.resize(views.size());
  parted.bottom.resize(views.size());
  for (std::size_t k = 0; k < views.size(); ++k) {
    if (views[k].box.empty()) continue;
    const std::string& sensor = session.sensors[k];
    const cv::Size size = session.dressed.at(sensor).color.size();
    const auto labels = votes(maps[k], views[k].box, picks, sensor, size);
    parted.top[k] = of_label(maps[k], labels, Label::top);
    parted.bottom[k] = of_label(maps[k], labels, Label::bottom);
    drop_artefacts(picks, "top", sensor, views[k].box, size, parted.top[k]);
    drop_artefacts(picks, "bottom", sensor, views[k].box, size, parted.bottom[k]);
    parted.has_top |= cv::countNonZero(parted.top[k]) > 0;
    parted.has_bottom |= cv::countNonZero(parted.bottom[k]) > 0;
  }
  return labelled_views(session, calibration, body, views, parted);
}

const Segment::Variant jseg_variant{"jseg", jseg_named, {"label_*"}};

}  // namespace
}  // namespace dressform
