#pragma once
#include <functional>
#include <utility>
#include <vector>

#include "pipeline/fuse/align_frames.h"

namespace dressform {

// Poses of a scan's frames in the frame of the first usable one.
struct Track {
  std::vector<Isometry3d> world_from_frame;
  std::vector<char> tracked;  // false: the pose means nothing
  double residual_rms_m = 0;
  double loop_closure_m = 0;  // how far the loop was open before it was closed; 0 where there was none
  bool loop_found = false;
  int count_tracked() const;
};

// How the frames of a walk find their places among those before them.
struct FrameFollower {
  // Aligns a frame, started from a pose; called by several threads at once.
  std::function<FrameAlignment(int frame, const Isometry3d& start)> align;
  // Called with every frame whose pose is known, in order; the first one has the identity.
  std::function<void(int frame, const Isometry3d& world_from_frame)> tracked;
};

// Frame by frame, each started from where the last one was and from constant motion, and from small turns about the
// scanned object where that fails.
Track follow_frames(const ScanFrames& frames, const FrameFollower& follower);

// From what a hand moves between two frames down to the sensor's noise, with ever more points.
std::vector<CorrespondenceRejector> coarse_to_fine();
constexpr int kAlignmentIterations = 6;  // at each of these

// Every frame against a few frames before it.
Track track_odometry(const ScanFrames& frames, const Projector& projector);

// Finds where the walk comes back to its beginning, aligns the late frame with the early ones, and spreads the
// difference over the frames between in proportion.
Track close_loop(const ScanFrames& frames, const Projector& projector, Track track);

// Frames that look at the same side of the object: for every frame up to `per_frame` others, spread evenly over viewing
// directions less than largest_angle_deg apart.
std::vector<std::pair<int, int>> overlapping_pairs(const Track& track, int per_frame, double largest_angle_deg);

// Point nearest to the optical axes of all tracked frames: where the object stands.
Vector3d axes_crossing(const Track& track);

}  // namespace dressform
