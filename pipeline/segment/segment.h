#pragma once
#include <map>
#include <string>

#include "pipeline/extract/extract.h"
#include "pipeline/registration/registration.h"
#include "pipeline/run/stage.h"
#include "scenes/label.h"

namespace dressform {

struct Segmentation {
  std::map<std::string, cv::Mat> labels;  // by sensor; uint8 Label at colour size, raw (distorted) pixels
  // "top" -> "shirt", or "dress" where one garment hangs below the crotch; "bottom" -> "trousers" or "skirt"; absent:
  // not worn, or not to be told from the top (a skirt of the shirt's own print passes for a dress).
  std::map<std::string, std::string> kinds;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(labels, kinds);
  }
};

struct SegmentTag {
  static constexpr const char* name = "segment";
  static constexpr const char* default_variant = "joint_mrf";
};
// Dressed shots. Views that are not registered are labelled none throughout.
using Segment = Stage<SegmentTag, Segmentation(const CaptureSession&, const Calibration&, const BodyModel& naked,
                                               const ExtractedViews&, const Registration&)>;

}  // namespace dressform
