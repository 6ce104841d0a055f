#pragma once
#include <deque>
#include <unordered_map>
#include <vector>

#include "pipeline/fuse/frame_view.h"

namespace dressform {

// The model of frame-to-model tracking (Newcombe et al., "KinectFusion", ISMAR 2011): truncated distances that grow
// with every frame, looked at from anywhere by ray casting. World frame of the walk, metres. In blocks near what was
// seen, where the paper has a dense cube. The results do not depend on the number of threads.
class ModelVolume {
 public:
  // ir: the camera of the full images.
  ModelVolume(const Camera& ir, const VolumeOptions& options);

  // A frame into the weighted running average.
  void integrate(const cv::Mat& depth_m, const DepthMap& map, const Isometry3d& world_from_frame);

  // What a camera at the pose would see of the model: points and normals on the pixels of `grid`, sensor frame.
  // rays: normalized_grid of `grid`.
  DepthMap ray_cast(const Camera& grid, const cv::Mat& rays, const Isometry3d& world_from_frame) const;

 private:
  using Cell = VoxelBlock::Cell;
  struct Range {
    float near = 1e9f, far = 0;  // depth of the blocks that an image's tile shows
  };
  struct Sample {
    float distance = 0, weight = 0;
    Vector3f gradient = Vector3f::Zero();  // of the distance
  };
  // A walk from voxel to voxel, which stays in one block for a while.
  struct Cursor {
    Cell cell = Cell::Constant(1 << 30);
    const VoxelBlock* block = nullptr;
  };

  void allocate(const DepthMap& map, const Isometry3d& world_from_frame);
  const VoxelBlock* block_in(Cursor& cursor, const Cell& cell) const;
  bool interpolated(Cursor& cursor, const Vector3f& point, Sample& sample) const;
  float to_exit(const Cell& cell, const Vector3f& point, const Vector3f& ray) const;
  bool onto_surface(Cursor& cursor, const Vector3f& origin, const Vector3f& ray, float& depth, Sample& sample) const;
  bool hit(const Vector3f& origin, const Vector3f& ray, const Range& range, float& depth, Sample& sample) const;
  std::vector<Range> ranges(const Camera& grid, const Isometry3d& frame_from_world, int tiles_x, int tiles_y) const;

  Camera ir_;
  Projector projector_;
  VolumeOptions options_;
  float voxel_m_, block_m_;
  std::unordered_map<std::uint64_t, int> index_;  // of a block's key
  std::vector<Cell> cells_;
  std::deque<VoxelBlock> blocks_;
};

}  // namespace dressform
