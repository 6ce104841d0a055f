#include "pipeline/fuse/fuse_scan.h"

namespace dressform {
namespace {

struct FrameToFrameParams {
  FuseScanOptions scan;
};

template <class V>
void fields(V& v, FrameToFrameParams& p) {
  fuse_scan_fields(v, p.scan);
}

// Every frame against the few before it, and nothing else: errors add up along the walk. A baseline.
BodyModel frame_to_frame(const DepthScan& scan, const SensorCalibration& calibration,
                         const FrameToFrameParams& params) {
  const ScanFrames frames = checked_frames(scan, calibration, params.scan);
  const Projector projector(frames.first_usable().camera);
  return fuse_tracked(scan, frames, track_odometry(frames, projector), calibration, params.scan);
}

const Fuse::Variant frame_to_frame_variant{"frame_to_frame", frame_to_frame};

}  // namespace
}  // namespace dressform
