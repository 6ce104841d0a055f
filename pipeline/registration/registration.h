#pragma once
#include <map>
#include <string>

#include "pipeline/extract/extract.h"
#include "pipeline/fuse/fuse.h"
#include "pipeline/run/stage.h"
#include "scenes/capture_session.h"

namespace dressform {

// What speaks for and against a view's pose: tests against what did not make it.
struct PoseEvidence {
  double inlier_part = 0;          // of the mannequin's points
  double residual_over_noise = 0;  // RMS residual over what the sensor's and the model's noise explain
  double contradicted_part = 0;    // of the model's visible surface that the sensor looked through
  double looked_through_part = 0;  // of the view's mannequin that another registered view looked through, the most
  double floor_tilt_deg = 0, floor_height_m = 0;           // of the view's own floor, model frame; 0 where not seen
  double rotation_sigma_deg = 0, translation_sigma_m = 0;  // one standard deviation, at the body's centre

  template <class Archive>
  void serialize(Archive& archive) {
    archive(inlier_part, residual_over_noise, contradicted_part, looked_through_part, floor_tilt_deg, floor_height_m,
            rotation_sigma_deg, translation_sigma_m);
  }
};

// Where every sensor stands relative to the naked model. A view that could not be registered has no entry in
// model_from_sensor and converged = false: never an identity.
struct Registration {
  std::map<std::string, Isometry3d> model_from_sensor;  // IR camera
  std::map<std::string, bool> converged;
  std::map<std::string, double> residual_rms_m;  // point to plane on inliers
  std::map<std::string, int> inliers;
  std::map<std::string, PoseEvidence> evidence;  // of views that had a pose to judge
  std::map<std::string, std::string> problem;    // why a view has none, in a clause

  template <class Archive>
  void serialize(Archive& archive) {
    archive(model_from_sensor, converged, residual_rms_m, inliers, evidence, problem);
  }
};

struct RegisterTag {
  static constexpr const char* name = "registration";
  static constexpr const char* default_variant = "joint";
};

// Every sensor of the rig placed about the naked model, by its naked shot.
//
// In: raw naked depth (uint16, millimetres), cameras, the model (its frame: fuse.h), masks and floors of extract; a rig
// prior, rough, where there is one.
// Out: model_from_sensor takes metres of the IR camera's frame to the model's. The dressed shots share these poses: rig
// and mannequin do not move between the two.
// Throws InputError where the model has no surface or the session no sensors.
// Chen and Medioni, "Object modeling by registration of multiple range images", ICRA 1991; Pulli, "Multiview
// registration for large data sets", 3DIM 1999.
using Register = Stage<RegisterTag, Registration(const CaptureSession&, const Calibration&, const BodyModel& naked,
                                                 const ExtractedViews&)>;

}  // namespace dressform
