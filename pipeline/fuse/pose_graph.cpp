#include "pipeline/fuse/turning.h"

namespace dressform {
namespace {

struct PoseGraphParams {
  FuseScanOptions scan;
  int pairs_per_frame = 16;
  double largest_angle_deg = 50;
  int iterations = 8;
  double wide_m = 0.04, narrow_m = 0.02;
};

constexpr double kWideCosine = 0.8, kNarrowCosine = 0.85;  // least agreement of the normals of a pair, at each width
// Of the points, at each width: a million pairs hold six hundred unknowns; the first width only brings frames near.
constexpr int kWideStride = 4, kNarrowStride = 2;

template <class V>
void fields(V& v, PoseGraphParams& p) {
  fuse_scan_fields(v, p.scan);
  v("pairs_per_frame", p.pairs_per_frame, 2, 60, "", "other frames that every frame is aligned with at the end");
  v("largest_angle_deg", p.largest_angle_deg, 5.0, 90.0, "deg", "between the lines of sight of two aligned frames");
  v("iterations", p.iterations, 1, 50, "", "of the alignment of all frames, for each of two widths of the loss");
  v("wide_m", p.wide_m, 0.005, 0.5, "m", "first width of the loss of that alignment: the drift left by the loop");
  v("narrow_m", p.narrow_m, 0.002, 0.5, "m", "second width: about three sigmas of the sensor's noise");
}

// Frame by frame along the walk, the loop closed, then all frames with all frames that see the same side. The edges of
// the pose graph are linearised from the points again in every iteration (Pulli, "Multiview registration for large data
// sets", 3DIM 1999). Volume: Curless and Levoy, SIGGRAPH 1996.
BodyModel pose_graph(const DepthScan& scan, const SensorCalibration& calibration, const PoseGraphParams& params) {
  const auto follow = [&](const ScanFrames& frames, const Projector& projector) {
    Track track = close_loop(frames, projector, track_odometry(frames, projector));
    const auto pairs = overlapping_pairs(track, params.pairs_per_frame, params.largest_angle_deg);
    const std::vector<CorrespondenceRejector> gates{{params.wide_m, kWideCosine, kWideStride},
                                                    {params.narrow_m, kNarrowCosine, kNarrowStride}};
    const GlobalAlignment all = align_all(frames, projector, pairs, track.world_from_frame, gates, params.iterations);
    track.world_from_frame = all.world_from_frame;
    track.residual_rms_m = all.residual_rms_m;
    return track;
  };
  return fuse_followed(scan, calibration, followed_scan(scan, calibration, params.scan, follow));
}

const Fuse::Variant pose_graph_variant{"pose_graph", pose_graph};

}  // namespace
}  // namespace dressform
