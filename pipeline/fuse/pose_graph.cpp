#include "pipeline/fuse/fuse_scan.h"

namespace dressform {
namespace {

struct PoseGraphParams {
  FuseScanOptions scan;
  int pairs_per_frame = 16;
  double largest_angle_deg = 50;
  int iterations = 8;
};

template <class V>
void fields(V& v, PoseGraphParams& p) {
  fuse_scan_fields(v, p.scan);
  v("pairs_per_frame", p.pairs_per_frame, 2, 60, "", "other frames that every frame is aligned with at the end");
  v("largest_angle_deg", p.largest_angle_deg, 5.0, 90.0, "deg", "between the lines of sight of two aligned frames");
  v("iterations", p.iterations, 1, 50, "", "of the alignment of all frames, for each of two widths of the loss");
}

// Frame by frame along the walk, the loop closed, then all frames with all frames that see the same side. The edges of
// the pose graph are linearised from the points again in every iteration.
BodyModel pose_graph(const DepthScan& scan, const SensorCalibration& calibration, const PoseGraphParams& params) {
  const ScanFrames frames = checked_frames(scan, calibration, params.scan);
  const Projector projector(frames.first_usable().camera);
  Track track = close_loop(frames, projector, track_odometry(frames, projector));
  const auto pairs = overlapping_pairs(track, params.pairs_per_frame, params.largest_angle_deg);
  const std::vector<CorrespondenceRejector> gates{{0.04, 0.8, 1}, {0.02, 0.85, 1}};
  const GlobalAlignment all = align_all(frames, projector, pairs, track.world_from_frame, gates, params.iterations);
  track.world_from_frame = all.world_from_frame;
  track.residual_rms_m = all.residual_rms_m;
  return fuse_tracked(scan, frames, track, calibration, params.scan);
}

const Fuse::Variant pose_graph_variant{"pose_graph", pose_graph};

}  // namespace
}  // namespace dressform
