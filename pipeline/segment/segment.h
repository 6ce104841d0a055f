#pragma once
#include <map>
#include <string>

#include "pipeline/extract/extract.h"
#include "pipeline/registration/registration.h"
#include "pipeline/stage.h"
#include "scenes/label.h"

namespace dressform {

struct Segmentation {
  std::map<std::string, cv::Mat> labels;     // by sensor; uint8 Label at colour size, raw (distorted) pixels
  std::map<std::string, std::string> kinds;  // "top" -> "shirt"; "bottom" -> "trousers" or "skirt"; absent: not worn

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
