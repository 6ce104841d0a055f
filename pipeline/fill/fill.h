#pragma once
#include <map>
#include <string>

#include "pipeline/body/body_landmarks.h"
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
// The garments' colour and depth in every view, with what an arm hides of them filled in. In: the dressed shots, the
// naked body and its landmarks (m, model frame), poses, labels. Out: per garment and sensor, at the size of the colour
// image the colour (8-bit BGR) and a mask (uint8: 0, 255 seen, 128 filled), on the IR grid the depth (float32, mm,
// offset removed, 0 none); empty masks for views that are not registered. Throws InputError for a body without
// triangles. The thesis's (section 3.2.2) is thesis_random31, in the manner of texture synthesis by patches (Efros and
// Leung, ICCV 1999).
using Fill = Stage<FillTag, FilledViews(const CaptureSession&, const Calibration&, const KnownBody& naked,
                                        const Registration&, const Segmentation&)>;

}  // namespace dressform
