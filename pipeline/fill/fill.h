#pragma once
#include <map>
#include <string>

#include "pipeline/run/stage.h"
#include "pipeline/segment/segment.h"

namespace dressform {

// One garment in one view, with the parts that an arm hides filled in.
struct FilledGarment {
  cv::Mat color;      // 8-bit BGR at colour size; outside `mask` as captured
  cv::Mat mask;       // uint8 at colour size: 0 not garment, 255 seen, 128 filled in
  cv::Mat depth_mm;   // float32 on the IR grid, offset removed: the garment's surface, 0 = none
  cv::Mat synthetic;  // uint8 on the IR grid: 255 where depth was made up

  template <class Archive>
  void serialize(Archive& archive) {
    archive(color, mask, depth_mm, synthetic);
  }
};
struct FilledViews {
  std::map<std::string, std::map<std::string, FilledGarment>> garments;  // "top"/"bottom" -> sensor

  template <class Archive>
  void serialize(Archive& archive) {
    archive(garments);
  }
};

struct FillTag {
  static constexpr const char* name = "fill";
  static constexpr const char* default_variant = "reproject";
};
using Fill = Stage<FillTag, FilledViews(const CaptureSession&, const Calibration&, const BodyModel& naked,
                                        const Registration&, const Segmentation&)>;

}  // namespace dressform
