#include "pipeline/fuse/turning.h"

namespace dressform {
namespace {

struct FrameToFrameParams {
  FuseScanOptions scan;
};

template <class V>
void fields(V& v, FrameToFrameParams& p) {
  fuse_scan_fields(v, p.scan);
}

// Every frame against the few before it, and nothing else: errors add up along the walk. A baseline. Chen and Medioni,
// ICRA 1991; Blais and Levine, PAMI 1995 (pairs by projection); Curless and Levoy, SIGGRAPH 1996 (volume).
BodyModel frame_to_frame(const DepthScan& scan, const SensorCalibration& calibration,
                         const FrameToFrameParams& params) {
  return fuse_followed(scan, calibration, followed_scan(scan, calibration, params.scan, track_odometry));
}

const Fuse::Variant frame_to_frame_variant{"frame_to_frame", frame_to_frame};

}  // namespace
}  // namespace dressform
