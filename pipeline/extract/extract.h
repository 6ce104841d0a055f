#pragma once
#include <map>
#include <string>

#include "pipeline/fuse/fuse.h"
#include "pipeline/run/stage.h"
#include "scenes/capture_session.h"

namespace dressform {

// Where the mannequin is, in one view. uint8 masks: 255 mannequin (with clothes, when dressed; without the stand), 0
// not.
struct ViewMasks {
  cv::Mat naked, dressed;              // on the depth grid
  cv::Mat naked_color, dressed_color;  // at colour size
  bool found_naked = false, found_dressed = false;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(naked, dressed, naked_color, dressed_color, found_naked, found_dressed);
  }
};
struct ExtractedViews {
  std::map<std::string, ViewMasks> views;  // by sensor
  // The floor in each view's IR camera frame (n.p + d = 0, unit n pointing up); absent where no floor was seen.
  std::map<std::string, Eigen::Vector4d> floor_in_sensor;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(views, floor_in_sensor);
  }
};

struct ExtractTag {
  static constexpr const char* name = "extract";
  static constexpr const char* default_variant = "cluster";
};

// The mannequin cut out of the room, in every view, naked and dressed.
//
// In: raw shots of the rig, the cameras, and the naked model, of which only its height is used: no pose is known yet. A
// rig prior and the sensors' own body index help where they are there.
// Out: masks on the depth grid and at colour size, and the floor in each IR camera's frame. A view without a shot, or
// in which nothing looks like a standing body, has empty masks and found = false; a view without colour no colour
// masks. Throws InputError for a sensor of the session without a calibration. Fischler and Bolles, CACM 1981 (floor);
// Boykov and Jolly, "Interactive graph cuts", ICCV 2001 (outline in colour).
using Extract = Stage<ExtractTag, ExtractedViews(const CaptureSession&, const Calibration&, const BodyModel& naked)>;

}  // namespace dressform
