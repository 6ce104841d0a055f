#pragma once
#include <string>
#include <vector>

#include "pipeline/run/stage.h"
#include "scenes/camera.h"
#include "scenes/frame.h"
#include "scenes/mesh.h"

namespace dressform {

// A body scanned all round by one moving depth sensor.
struct BodyModel {
  Mesh body;                // closed, the body alone (no floor, no stand), model frame
  PointCloud surroundings;  // everything the scan saw that is static (body, stand, floor, furniture), with normals,
                            // model frame, thinned to about 1 cm: registration may lean on the floor
  std::vector<Isometry3d> model_from_frame;  // IR camera pose of every scan frame
  bool converged = false;
  double loop_closure_m = 0;  // drift between the last and the first frame before it was spread
  double residual_rms_m = 0;  // point to plane, last pass
  int frames_used = 0;
  bool floor_seen = true;  // else gravity is the sensors' mean upright, and y = 0 is a guess
  double turned_deg = 0;   // how far round the body the line of sight went
  std::string note;        // what was unusual about the scan, in a sentence; empty: nothing

  template <class Archive>
  void serialize(Archive& archive) {
    archive(body, surroundings, model_from_frame, converged, loop_closure_m, residual_rms_m, frames_used, floor_seen,
            turned_deg, note);
  }
};

struct FuseTag {
  static constexpr const char* name = "fuse";
  static constexpr const char* default_variant = "pose_graph";
};

// One body from one scan: the naked mannequin, and the user.
//
// In: the frames of a depth sensor that was carried round the body (uint16, millimetres, 0 = none, in order of time)
// and its calibration. The body stands still on a floor. Out: model frame, metres, y up (gravity, from the floor
// plane), floor at y = 0, the body's axis at x = z = 0. The heading about y is the scan's own and means nothing. A scan
// without a floor (a bust) has no zero of height (floor_seen = false); one before which someone turned instead is
// followed by what moves. The body is closed, outward and of one piece, without handles. Frames that could not be
// tracked have a pose of NaNs; converged = false where nothing turned, half of the frames were lost, or nothing stood
// there: the body may then be empty. Throws InputError where fewer than ten frames have enough depth, or images do not
// have the calibration's size. Curless and Levoy, "A volumetric method for building complex models from range images",
// SIGGRAPH 1996; Newcombe et al., "KinectFusion", ISMAR 2011.
using Fuse = Stage<FuseTag, BodyModel(const DepthScan&, const SensorCalibration&)>;

}  // namespace dressform
