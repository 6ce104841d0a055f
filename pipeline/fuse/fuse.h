#pragma once
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

  template <class Archive>
  void serialize(Archive& archive) {
    archive(body, surroundings, model_from_frame, converged, loop_closure_m, residual_rms_m, frames_used);
  }
};

struct FuseTag {
  static constexpr const char* name = "fuse";
  static constexpr const char* default_variant = "pose_graph";
};

// Model frame: metres, y up (gravity, from the floor plane), floor at y = 0, the body's axis at x = z = 0. The heading
// about y is the scan's own and means nothing.
using Fuse = Stage<FuseTag, BodyModel(const DepthScan&, const SensorCalibration&)>;

}  // namespace dressform
