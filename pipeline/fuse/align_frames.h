#pragma once
#include <utility>
#include <vector>

#include "pipeline/alignment/pair_equations.h"
#include "pipeline/fuse/scan_frames.h"

namespace dressform {

struct FrameAlignment {
  Isometry3d world_from_frame = Isometry3d::Identity();
  double residual_rms_m = 0;
  double inlier_part = 0;  // of the points that fell into the targets' images
  double cost = 0;         // mean robust loss
  bool converged = false;
};

// A depth map that stays where it is.
struct FixedMap {
  const DepthMap& map;
  Isometry3d world_from_map;
};

// Aligns some points of a depth map (indices) to others that stay fixed, through the gates in turn (iterations each).
FrameAlignment align_to_maps(const DepthMap& map, const std::vector<int>& samples, const Projector& projector,
                             const std::vector<FixedMap>& targets, const Isometry3d& initial,
                             const std::vector<CorrespondenceRejector>& gates, int iterations);

// Aligns one frame to others whose poses stay fixed, through the gates in turn (iterations each).
FrameAlignment align_to_frames(const ScanFrames& frames, const Projector& projector, int frame,
                               const std::vector<int>& targets, const std::vector<Isometry3d>& world_from_frame,
                               const Isometry3d& initial, const std::vector<CorrespondenceRejector>& gates,
                               int iterations);

struct GlobalAlignment {
  std::vector<Isometry3d> world_from_frame;
  double residual_rms_m = 0;
  double last_step_m = 0;  // largest motion of a frame in the last iteration
  int iterations = 0;
};

// All poses at once over the given undirected pairs; frames in no pair and the first paired frame stay where they are.
// The sum over pairs of point-to-plane terms is linearised again in every iteration, so that there is no drift to
// spread afterwards (multi-view registration in the sense of Pulli, 3DIM 1999).
GlobalAlignment align_all(const ScanFrames& frames, const Projector& projector,
                          const std::vector<std::pair<int, int>>& pairs, std::vector<Isometry3d> world_from_frame,
                          const std::vector<CorrespondenceRejector>& gates, int iterations);

}  // namespace dressform
