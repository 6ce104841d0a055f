#pragma once
#include <map>
#include <string>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/extract/extract.h"
#include "pipeline/garment/garment_layout.h"
#include "pipeline/registration/registration.h"
#include "pipeline/run/stage.h"
#include "scenes/label.h"

namespace dressform {

struct Segmentation {
  std::map<std::string, cv::Mat> labels;  // by sensor; uint8 Label at colour size, raw (distorted) pixels
  // "top": "shirt", or "dress" where one garment hangs below the crotch; "bottom": "trousers" or "skirt"; absent: not
  // worn, or not to be told from the top (a skirt of the shirt's own print passes for a dress). Ends as the pixels show
  // them; how the two lie to one another is left open.
  GarmentLayouts garments;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(labels, garments);
  }
};

struct SegmentTag {
  static constexpr const char* name = "segment";
  static constexpr const char* default_variant = "joint_mrf";
};
// Who is what in the dressed shots: skin, top, bottom; and what garments there are. In: colour (8-bit BGR) and depth
// (mm, raw) of the dressed and, where there are, the naked shots, the naked body and its landmarks (m, model frame),
// masks and poses of the views. Out: uint8 labels at the size of each colour image (raw pixels: 0 none, 1 skin, 2 top,
// 3 bottom) and a layout for each garment (m, model frame). Views that are not registered are labelled none throughout.
// Throws InputError for a body without triangles. Papers: JSEG (Deng and Manjunath, PAMI 2001) is the thesis's;
// joint_mrf cuts graphs (Boykov and Jolly, ICCV 2001) over learnt colours (Rother, Kolmogorov and Blake, GrabCut,
// SIGGRAPH 2004).
using Segment = Stage<SegmentTag, Segmentation(const CaptureSession&, const Calibration&, const KnownBody& naked,
                                               const ExtractedViews&, const Registration&)>;

}  // namespace dressform
