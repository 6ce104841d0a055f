#pragma once
#include <functional>

#include "pipeline/segment/jseg_naming.h"
#include "pipeline/segment/labelled_views.h"

namespace dressform {

// What the variants share that look for regions of the photographs first and for their names then.
struct NamedRegionParams {
  FactParams facts;
  NamingParams naming;
  int closing_px = 3;
};
template <class V>
void naming_fields(V& v, NamedRegionParams& p) {
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

// Connected regions of one view's crop. bgr: 8-bit; body: uint8, 0 = not to be looked at; scale: of the whole image,
// its width over 1920. Labels from 1, 0 outside the body.
using FindRegions = std::function<LabelMap(const cv::Mat& bgr, const cv::Mat& body, double scale)>;

// The regions of every view, named by what is known of the naked body: nobody's hand is needed. `variant` names who
// asks in errors. Throws InputError as the stage does.
Segmentation named_regions(const CaptureSession& session, const Calibration& calibration, const KnownBody& naked,
                           const ExtractedViews& extracted, const Registration& registration, const char* variant,
                           const FindRegions& find, const NamedRegionParams& params);

}  // namespace dressform
