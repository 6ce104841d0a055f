#pragma once
#include <utility>
#include <vector>

#include "pipeline/fuse/scan_frames.h"

namespace dressform {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

// Normal equations of one directed pair of frames, point to plane with projective association (Chen and Medioni, 1991;
// Blais and Levine, 1995). Twists are (rotation, translation) of the world frame; the same matrix serves both frames
// with opposite signs.
struct PairEquations {
  Matrix6d matrix = Matrix6d::Zero();
  Vector6d vector = Vector6d::Zero();
  double squared_residual_m2 = 0;  // sum over inliers, unweighted
  double cost = 0;                 // sum of the robust loss over all points that fell into the target's image
  int inliers = 0, visible = 0;
};

// How points of a pair are judged.
struct PairGate {
  double distance_m =
      0.04;  // Tukey's constant for the distance to the plane; associations beyond 1.5 times this are none
  double normal_cosine = 0.8;  // least agreement of the normals
  int stride = 1;              // of the source's samples
};

PairEquations pair_equations(const ScanFrames& frames, const Projector& projector, int source, int target,
                             const Isometry3d& world_from_source, const Isometry3d& world_from_target,
                             const PairGate& gate);

// exp of a twist (rotation vector, translation) as a rigid motion.
Isometry3d exponential(const Vector6d& twist);

struct FrameAlignment {
  Isometry3d world_from_frame = Isometry3d::Identity();
  double residual_rms_m = 0;
  double inlier_part = 0;  // of the points that fell into the targets' images
  double cost = 0;         // mean robust loss
  bool converged = false;
};

// Aligns one frame to others whose poses stay fixed, through the gates in turn (iterations each).
FrameAlignment align_to_frames(const ScanFrames& frames, const Projector& projector, int frame,
                               const std::vector<int>& targets, const std::vector<Isometry3d>& world_from_frame,
                               const Isometry3d& initial, const std::vector<PairGate>& gates, int iterations);

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
                          const std::vector<PairGate>& gates, int iterations);

}  // namespace dressform
