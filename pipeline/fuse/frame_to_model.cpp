#include "pipeline/fuse/model_volume.h"
#include "pipeline/fuse/turning.h"

namespace dressform {
namespace {

struct FrameToModelParams {
  FuseScanOptions scan;
  double tracking_voxel_m = 0.008, tracking_truncation_m = 0.03;
};

template <class V>
void fields(V& v, FrameToModelParams& p) {
  fuse_scan_fields(v, p.scan);
  v("tracking_voxel_m", p.tracking_voxel_m, 0.003, 0.05, "m",
    "edge of a voxel of the model that frames are aligned with");
  v("tracking_truncation_m", p.tracking_truncation_m, 0.006, 0.2, "m", "distances in that model are cut at this");
  v("cut_ends", p.scan.surface.cut_ends,
    "take head, neck, hands and feet off the body, as figure 3.35 of the thesis does; later stages that look for them "
    "then find none");
}

// Every frame against the model of all frames before it, as a camera at the last frame's place would see it (projective
// point to plane, coarse to fine), then into its weighted running average: Newcombe et al., "KinectFusion: real-time
// dense surface mapping and tracking", ISMAR 2011. No loop is closed but by the model itself, to which the walk comes
// back. The body is then fused of the same frames at the same poses in finer voxels, upright, and closed by Poisson's
// reconstruction (Kazhdan and Hoppe, ACM TOG 2013), as in the thesis (section 3.3 and figure 3.35).
BodyModel frame_to_model(const DepthScan& scan, const SensorCalibration& calibration,
                         const FrameToModelParams& params) {
  VolumeOptions coarse = params.scan.volume;
  coarse.voxel_m = params.tracking_voxel_m;
  coarse.truncation_m = params.tracking_truncation_m;
  const auto follow = [&](const ScanFrames& frames, const Projector& projector) {
    const Camera& grid = frames.first_usable().camera;
    const cv::Mat rays = normalized_grid(grid);
    ModelVolume volume(calibration.ir, coarse);
    DepthMap seen;  // of the model, from the last frame's pose
    Isometry3d world_from_seen = Isometry3d::Identity();
    FrameFollower follower;
    follower.align = [&](int frame, const Isometry3d& start) {
      return align_to_maps(frames.maps[frame], frames.samples[frame], projector, {{seen, world_from_seen}}, start,
                           coarse_to_fine(), kAlignmentIterations);
    };
    follower.tracked = [&](int frame, const Isometry3d& world_from_frame) {
      volume.integrate(frames.depth_m[frame], frames.maps[frame], world_from_frame);
      world_from_seen = world_from_frame;
      seen = volume.ray_cast(grid, rays, world_from_frame);
    };
    return follow_frames(frames, follower);
  };
  return fuse_followed(scan, calibration, followed_scan(scan, calibration, params.scan, follow));
}

const Fuse::Variant frame_to_model_variant{"frame_to_model", frame_to_model};

}  // namespace
}  // namespace dressform
