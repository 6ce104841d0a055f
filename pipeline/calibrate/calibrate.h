#pragma once
#include <map>
#include <string>

#include "pipeline/run/stage.h"
#include "scenes/capture_session.h"

namespace dressform {

struct CalibrateTag {
  static constexpr const char* name = "calibrate";
  static constexpr const char* default_variant = "automatic";
};

// What the boards gave for one sensor. Residuals are those of the final cameras with each board's pose fitted to the
// corners of both images.
struct BoardReport {
  int shots = 0, found_ir = 0, found_color = 0;      // boards found
  int used_ir = 0, used_color = 0;                   // not rejected
  int turned = 0;                                    // pairs whose corner order was turned by 180 degrees and put right
  double ir_rms_px = 0, color_rms_px = 0;            // root mean square of the corners' distances
  double depth_rms_mm = 0;                           // of the boards' mean (measured depth - offset - plane)
  double depth_slope_mm_per_m = 0;                   // of the same over distance: 10 is a focal length 1 % off
  int depth_views = 0;                               // boards with depth
  double ir_focal_sigma = 0, color_focal_sigma = 0;  // relative; expected from the corners' scatter. 0: not known
  bool converged = false;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(shots, found_ir, found_color, used_ir, used_color, turned, ir_rms_px, color_rms_px, depth_rms_mm,
            depth_slope_mm_per_m, depth_views, ir_focal_sigma, color_focal_sigma, converged);
  }
};

struct Calibrated {
  Calibration calibration;
  std::map<std::string, BoardReport> boards;  // sensors calibrated from boards
  std::map<std::string, std::string> notes;   // by sensor: why its boards were not used, what they leave open

  template <class Archive>
  void serialize(Archive& archive) {
    archive(calibration, boards, notes);
  }
};

// Intrinsics, distortion, color_from_ir and depth offset of every sensor of the session, the hand-held one included.
//
// In: the session; its boards' shots (raw images of any number of sensors) or its own calibration, whichever the
// variant uses. Variants that use boards take the session's own calibration for sensors without board shots. Out:
// cameras in pixels of the raw images (centres at integers), Brown's distortion in OpenCV's order; color_from_ir takes
// metres of the infrared camera's frame (x right, y down, z forward) to the colour camera's; depth_offset_m is what
// measured depth is too long. `boards`: residuals of the sensors calibrated here; converged = false where the boards
// leave a focal length open. Throws InputError, naming file or sensor, where neither boards nor a calibration are there
// for a sensor, too few boards were found, images are mirrored or do not belong together, or depth does not show the
// boards. Zhang, "A flexible new technique for camera calibration", PAMI 2000; Brown, "Close-range camera calibration",
// 1971.
using Calibrate = Stage<CalibrateTag, Calibrated(const CaptureSession&)>;

}  // namespace dressform
