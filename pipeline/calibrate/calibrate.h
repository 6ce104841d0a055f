#pragma once
#include "pipeline/stage.h"
#include "scenes/capture_session.h"

namespace dressform {

struct CalibrateTag {
  static constexpr const char* name = "calibrate";
  static constexpr const char* default_variant = "from_session";
};

// Intrinsics, distortion, color_from_ir and depth offset of every sensor of the session, the hand-held one included.
using Calibrate = Stage<CalibrateTag, Calibration(const CaptureSession&)>;

}  // namespace dressform
