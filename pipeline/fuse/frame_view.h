#pragma once
#include <vector>

#include "pipeline/fuse/voxel_block.h"
#include "pipeline/imaging/depth_map.h"

namespace dressform {

// What a volume needs to know of a frame, laid out for the inner loop.
struct FrameView {
  struct Observation {
    float along = 0;   // minus normal times ray (of unit z): from a step in depth to one off the plane
    float weight = 0;  // 0: none
  };
  cv::Mat depth_m;
  int shrink = 1, width = 0, height = 0;  // of the grid below
  std::vector<Observation> observations;
  int tiles_x = 0, tiles_y = 0;
  std::vector<float> farthest;  // depth in every tile of the grid; 0: none
  Eigen::Matrix3f rotation;     // sensor from volume
  Vector3f translation;
};

FrameView frame_view(const cv::Mat& depth_m, const DepthMap& map, const Camera& camera,
                     const Isometry3d& frame_from_volume, double min_cosine);

// Whether the block whose first voxel lies at `origin` (volume's frame) may hold anything that the frame saw, or that
// lies in front of it.
bool may_see(const FrameView& view, const Projector& projector, const Camera& camera, const Vector3f& origin,
             float voxel_m);

// One frame into one block that it may see: the running average of Curless and Levoy, SIGGRAPH 1996. Rows of voxels are
// projected at both ends and filled in between: over a block the projection is straight to a few hundredths of a pixel.
void integrate(const FrameView& view, const Projector& projector, const Vector3f& origin, const VolumeOptions& options,
               VoxelBlock& block);

}  // namespace dressform
