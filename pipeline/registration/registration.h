#pragma once
#include <map>
#include <string>

#include "pipeline/extract/extract.h"
#include "pipeline/fuse/fuse.h"
#include "pipeline/run/stage.h"
#include "scenes/capture_session.h"

namespace dressform {

// Where every sensor stands relative to the naked model. A view that could not be registered has no entry in
// model_from_sensor and converged = false: never an identity.
struct Registration {
  std::map<std::string, Isometry3d> model_from_sensor;  // IR camera
  std::map<std::string, bool> converged;
  std::map<std::string, double> residual_rms_m;  // point to plane on inliers
  std::map<std::string, int> inliers;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(model_from_sensor, converged, residual_rms_m, inliers);
  }
};

struct RegisterTag {
  static constexpr const char* name = "registration";
  static constexpr const char* default_variant = "joint";
};
using Register = Stage<RegisterTag, Registration(const CaptureSession&, const Calibration&, const BodyModel& naked,
                                                 const ExtractedViews&)>;

}  // namespace dressform
