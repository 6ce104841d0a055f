#pragma once
#include "pipeline/fuse/block_volume.h"
#include "pipeline/fuse/body_points.h"
#include "pipeline/fuse/closed_body.h"
#include "pipeline/fuse/fuse.h"
#include "pipeline/fuse/track.h"

namespace dressform {

// What the variants of the stage share: everything before and after the poses.
struct FuseScanOptions {
  int samples_per_direction = 30;
  double max_depth_m = 4.5;
  double region_radius_m = 0.85;
  VolumeOptions volume;
  BodyPointsOptions points;
  ClosedBodyOptions surface;
};

template <class V>
void fuse_scan_fields(V& v, FuseScanOptions& p) {
  v("samples_per_direction", p.samples_per_direction, 5, 500, "",
    "points of a frame used for tracking in each of 216 bins of normal directions");
  v("max_depth_m", p.max_depth_m, 1.0, 8.0, "m", "depth beyond this is not used");
  v("region_radius_m", p.region_radius_m, 0.3, 2.0, "m", "of the upright cylinder that holds the body");
  v("voxel_m", p.volume.voxel_m, 0.002, 0.02, "m", "edge of one voxel");
  v("truncation_m", p.volume.truncation_m, 0.004, 0.08, "m", "distances are cut at this");
  v("min_cosine", p.volume.min_cosine, 0.1, 0.9, "", "least cosine between surface normal and line of sight");
  v("floor_cut_m", p.points.floor_cut_m, 0.0, 0.05, "m", "points lower than this belong to the floor");
  v("gap_m", p.points.gap_m, 0.005, 0.05, "m", "points farther apart than this are different things");
  v("poisson_depth", p.surface.poisson_depth, 6, 10, "", "depth of the octree of the closed surface");
  v("least_views", p.surface.free_space.least_views, 1, 1000, "",
    "frames that saw through a place inside the closed surface, for it to be empty");
}

// Throws InputError when the scan has fewer than ten frames with enough depth or the images do not fit the calibration.
ScanFrames checked_frames(const DepthScan& scan, const SensorCalibration& calibration, const FuseScanOptions& options);

// Model frame from poses: gravity from the floor where one was seen, then the volume, the body and its surroundings.
BodyModel fuse_tracked(const DepthScan& scan, const ScanFrames& frames, const Track& track,
                       const SensorCalibration& calibration, const FuseScanOptions& options);

}  // namespace dressform
