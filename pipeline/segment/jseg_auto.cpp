#include "pipeline/segment/jseg_regions.h"
#include "pipeline/segment/named_regions.h"

namespace dressform {
namespace {

struct JsegAutoParams {
  JsegParams regions;
  NamedRegionParams naming;
};
template <class V>
void fields(V& v, JsegAutoParams& p) {
  fields(v, p.regions);
  naming_fields(v, p.naming);
}

// The regions of JSEG in every view, named by what is known of the naked body: nobody's hand is needed.
Segmentation jseg_auto(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                       const ExtractedViews& extracted, const Registration& registration,
                       const JsegAutoParams& params) {
  const auto find = [&](const cv::Mat& bgr, const cv::Mat& body, double) {
    const JsegResult found = jseg(bgr, body, params.regions);
    return LabelMap{found.regions, found.region_count};
  };
  return named_regions(session, calibration, naked, extracted, registration, "segment.jseg_auto", find, params.naming);
}

const Segment::Variant jseg_auto_variant{"jseg_auto", jseg_auto};

}  // namespace
}  // namespace dressform
