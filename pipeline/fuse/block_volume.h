#pragma once
#include <cstdint>
#include <vector>

#include "pipeline/fuse/frame_view.h"
#include "pipeline/fuse/scan_frames.h"
#include "scenes/mesh.h"

namespace dressform {

// An upright cylinder in the model frame (y up): where a volume is wanted.
struct VolumeRegion {
  double center_x = 0, center_z = 0, radius_m = 1, low_y = 0.006, high_y = 2.5;
  bool contains(const Vector3f& p) const {
    const double dx = p.x() - center_x, dz = p.z() - center_z;
    return p.y() > low_y && p.y() < high_y && dx * dx + dz * dz < radius_m * radius_m;
  }
};

// Truncated signed distances (Curless and Levoy, SIGGRAPH 1996) in blocks of 8 x 8 x 8 voxels near what was seen.
// Distances are taken to the plane of the observation, not along the ray, and weighted by the sensor's expected noise
// and by the square of the cosine to the line of sight. Every block is filled by one thread over the frames in order:
// the result does not depend on the number of threads.
class BlockVolume {
 public:
  static constexpr int kEdge = VoxelBlock::kEdge, kVoxels = VoxelBlock::kVoxels;

  // Fuses the frames whose `used` is set; model_from_frame: IR camera poses; y up.
  BlockVolume(const ScanFrames& frames, const Camera& camera, const std::vector<Isometry3d>& model_from_frame,
              const std::vector<char>& used, const VolumeRegion& region, const VolumeOptions& options);

  // Points where the distance changes sign between neighbouring voxels, with normals along the gradient; one for each
  // voxel that has any. `least_observations`: frames that must have seen both voxels.
  PointCloud surface_points(int least_observations) const;

 private:
  using Cell = VoxelBlock::Cell;

  void allocate(const ScanFrames& frames, const std::vector<Isometry3d>& model_from_frame,
                const std::vector<char>& used, const VolumeRegion& region);
  const VoxelBlock* find(const Cell& block) const;
  // Distance and observations of a voxel anywhere; false when it is in no block or was never seen.
  bool read(const Cell& voxel, int least_observations, float& distance) const;
  bool gradient(const Cell& voxel, Vector3f& result) const;
  void block_points(std::size_t block, int least_observations, PointCloud& cloud) const;

  VolumeOptions options_;
  std::vector<std::uint64_t> keys_;  // sorted
  std::vector<VoxelBlock> blocks_;   // as keys_
};

}  // namespace dressform
