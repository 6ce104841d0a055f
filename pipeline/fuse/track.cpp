#include "pipeline/fuse/track.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

#include "scenes/small_solvers.h"
#include "scenes/statistics.h"

namespace dressform {
namespace {

constexpr double kLeastInlierPart = 0.35;  // of the points in the targets' images: a wrong place shares the floor alone
constexpr float kUsualDistance_m = 2;      // of who walks round a body
constexpr double kSuspiciousCost = 1.5;    // of a frame's alignment, relative to the median before

constexpr double kOrbitStep_deg = 3;   // starts round the object, where motion went on otherwise ...
constexpr int kOrbitSteps = 4;         // ... to either side: 12 degrees, more than anybody turns between frames
constexpr double kLoopAngle_deg = 12;  // between the lines of sight of two frames that may close the loop
constexpr int kLoopFrames = 3;         // to either side of the early frame that the late one is aligned with
constexpr double kNoCrossing = 5e-4;   // pull of an axis towards a point in front, where the axes hardly cross

constexpr CorrespondenceRejector kAcrossTheLoop{0.3, 0.5, 4};  // the drift of a whole walk

Vector3d viewing_direction(const Isometry3d& world_from_frame) { return world_from_frame.linear().col(2); }

double viewing_angle(const Track& track, int a, int b) {
  const double cosine = viewing_direction(track.world_from_frame[a]).dot(viewing_direction(track.world_from_frame[b]));
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

// The frames a new frame is aligned with: the last tracked ones at doubling distances.
std::vector<int> recent_frames(const std::vector<int>& tracked) {
  std::vector<int> result;
  for (const std::size_t back : {1, 2, 4, 7})
    if (back <= tracked.size()) result.push_back(tracked[tracked.size() - back]);
  return result;
}

// Where the object in front of a sensor stands: the median depth of the middle of the image, along the axis.
double object_distance(const DepthMap& map) { return median_or(middle_depths_m(map), kUsualDistance_m); }

// The sensor moved on a circle round the object in front of it, about its own vertical.
Isometry3d orbited(const Isometry3d& world_from_frame, double distance_m, double angle_rad) {
  const Eigen::Translation3d to_object(0, 0, distance_m);
  return world_from_frame * to_object * Eigen::AngleAxisd(angle_rad, Vector3d::UnitY()) * to_object.inverse();
}

// Where a frame may be: moved on as its predecessors moved, averaged over the last few, and where the last one was.
std::vector<Isometry3d> predictions(const Track& track, const std::vector<int>& tracked, int frame) {
  const Isometry3d& last = track.world_from_frame[tracked.back()];
  std::vector<Isometry3d> starts{last};
  constexpr std::size_t kSteps = 4;
  if (tracked.size() <= kSteps) return starts;
  const int before = tracked[tracked.size() - 1 - kSteps];
  const Isometry3d motion = track.world_from_frame[before].inverse() * last;
  const double part = static_cast<double>(frame - tracked.back()) / (tracked.back() - before);
  const Eigen::AngleAxisd turn(motion.linear());
  Isometry3d step = Isometry3d::Identity();
  step.linear() = Eigen::AngleAxisd(part * turn.angle(), turn.axis()).toRotationMatrix();
  step.translation() = part * motion.translation();
  starts.push_back(last * step);
  return starts;
}

bool good(const FrameAlignment& alignment) { return alignment.converged && alignment.inlier_part > kLeastInlierPart; }

using AlignFrame = std::function<FrameAlignment(int frame, const Isometry3d& start)>;

// The best of several starts by its robust cost.
FrameAlignment best_alignment(const AlignFrame& align, int frame, const std::vector<Isometry3d>& starts) {
  std::vector<FrameAlignment> results(starts.size());
  tbb::parallel_for(std::size_t{0}, starts.size(), [&](std::size_t k) { results[k] = align(frame, starts[k]); });
  FrameAlignment best;
  for (const auto& each : results)
    if (good(each) && (!best.converged || each.cost < best.cost)) best = each;
  return best;
}

std::vector<Isometry3d> orbit_starts(const Isometry3d& pose, double distance_m) {
  std::vector<Isometry3d> starts;
  for (int k = -kOrbitSteps; k <= kOrbitSteps; ++k)
    starts.push_back(orbited(pose, distance_m, k * kOrbitStep_deg * M_PI / 180));
  return starts;
}

// A pair of frames far apart in time that look the same way, nearest in direction; {-1, -1} without one.
std::pair<int, int> loop_candidate(const Track& track) {
  const int count = static_cast<int>(track.world_from_frame.size());
  std::pair<int, int> best{-1, -1};
  double best_angle = kLoopAngle_deg * M_PI / 180;
  for (int late = count - 1; late >= 0; --late) {
    if (!track.tracked[late]) continue;
    for (int early = 0; early < late - count / 2; ++early) {
      if (!track.tracked[early]) continue;
      const double angle = viewing_angle(track, early, late);
      if (angle < best_angle) best_angle = angle, best = {early, late};
    }
  }
  return best;
}

// `part` of a rigid motion given in the world frame.
Isometry3d fraction(const Isometry3d& motion, const Vector3d& centre, double part) {
  const Eigen::AngleAxisd turn(motion.linear());
  const Vector3d step = motion * centre - centre;
  Isometry3d result = Isometry3d::Identity();
  result.linear() = Eigen::AngleAxisd(part * turn.angle(), turn.axis()).toRotationMatrix();
  result.translation() = centre + part * step - result.linear() * centre;
  return result;
}

}  // namespace

int Track::count_tracked() const { return static_cast<int>(std::count(tracked.begin(), tracked.end(), 1)); }

std::vector<CorrespondenceRejector> coarse_to_fine() {
  return {{0.2, 0.5, 4}, {0.08, 0.7, 3}, {0.04, 0.8, 2}, {0.02, 0.85, 1}};
}

Track follow_frames(const ScanFrames& frames, const FrameFollower& follower) {
  Track track;
  track.world_from_frame.assign(frames.count(), Isometry3d::Identity());
  track.tracked.assign(frames.count(), 0);
  std::vector<int> tracked;
  std::vector<double> costs;
  double squares = 0;
  for (int i = 0; i < frames.count(); ++i) {
    if (!frames.usable[i]) continue;
    if (!tracked.empty()) {
      auto starts = predictions(track, tracked, i);
      FrameAlignment found = best_alignment(follower.align, i, starts);
      if (!good(found) || found.cost > kSuspiciousCost * median_or(costs, 0.0)) {
        const auto more = orbit_starts(starts.back(), object_distance(frames.maps[i]));
        starts.insert(starts.end(), more.begin(), more.end());
        found = best_alignment(follower.align, i, starts);
      }
      if (!good(found)) continue;
      track.world_from_frame[i] = found.world_from_frame;
      costs.push_back(found.cost);
      squares += found.residual_rms_m * found.residual_rms_m;
    }
    track.tracked[i] = 1;
    tracked.push_back(i);
    follower.tracked(i, track.world_from_frame[i]);
  }
  track.residual_rms_m = tracked.size() > 1 ? std::sqrt(squares / (tracked.size() - 1)) : 0;
  return track;
}

Track track_odometry(const ScanFrames& frames, const Projector& projector) {
  std::vector<int> tracked;
  std::vector<Isometry3d> world_from_frame(frames.count(), Isometry3d::Identity());
  FrameFollower follower;
  follower.align = [&](int frame, const Isometry3d& start) {
    return align_to_frames(frames, projector, frame, recent_frames(tracked), world_from_frame, start, coarse_to_fine(),
                           kAlignmentIterations);
  };
  follower.tracked = [&](int frame, const Isometry3d& pose) {
    tracked.push_back(frame);
    world_from_frame[frame] = pose;
  };
  return follow_frames(frames, follower);
}

Track close_loop(const ScanFrames& frames, const Projector& projector, Track track) {
  const auto [early, late] = loop_candidate(track);
  if (early < 0) return track;
  std::vector<int> targets;
  for (int i = std::max(0, early - kLoopFrames); i <= std::min(frames.count() - 1, early + kLoopFrames); ++i)
    if (track.tracked[i]) targets.push_back(i);
  const Isometry3d& open = track.world_from_frame[late];
  const auto starts = orbit_starts(open, object_distance(frames.maps[late]));
  std::vector<CorrespondenceRejector> gates = coarse_to_fine();
  gates.insert(gates.begin(), kAcrossTheLoop);
  const auto align = [&](int frame, const Isometry3d& start) {
    return align_to_frames(frames, projector, frame, targets, track.world_from_frame, start, gates,
                           kAlignmentIterations);
  };
  const FrameAlignment found = best_alignment(align, late, starts);
  if (!good(found)) return track;
  track.loop_found = true;
  const Isometry3d correction = found.world_from_frame * open.inverse();
  track.loop_closure_m = (found.world_from_frame.translation() - open.translation()).norm();
  const Vector3d centre = axes_crossing(track);
  for (int i = early + 1; i < frames.count(); ++i) {
    const double part = std::min(1.0, static_cast<double>(i - early) / (late - early));
    track.world_from_frame[i] = fraction(correction, centre, part) * track.world_from_frame[i];
  }
  return track;
}

std::vector<std::pair<int, int>> overlapping_pairs(const Track& track, int per_frame, double largest_angle_deg) {
  const int count = static_cast<int>(track.world_from_frame.size());
  std::set<std::pair<int, int>> pairs;
  for (int i = 0; i < count; ++i) {
    if (!track.tracked[i]) continue;
    std::vector<std::pair<double, int>> near;
    for (int j = 0; j < count; ++j) {
      if (j == i || !track.tracked[j]) continue;
      const double angle = viewing_angle(track, i, j);
      if (angle < largest_angle_deg * M_PI / 180) near.emplace_back(angle, j);
    }
    std::sort(near.begin(), near.end());
    const int kept = std::min(per_frame, static_cast<int>(near.size()));
    for (int k = 0; k < kept; ++k) {
      const int j = near[static_cast<std::size_t>(k) * near.size() / kept].second;
      pairs.emplace(std::min(i, j), std::max(i, j));
    }
  }
  return {pairs.begin(), pairs.end()};
}

Vector3d axes_crossing(const Track& track) {
  Eigen::Matrix3d matrix = 2 * kNoCrossing * Eigen::Matrix3d::Identity();
  Vector3d vector = Vector3d::Zero();
  for (std::size_t i = 0; i < track.world_from_frame.size(); ++i) {
    if (!track.tracked[i]) continue;
    const Vector3d axis = viewing_direction(track.world_from_frame[i]);
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axis * axis.transpose();
    const Vector3d ahead = track.world_from_frame[i] * Vector3d(0, 0, kUsualDistance_m);
    matrix += across + kNoCrossing * Eigen::Matrix3d::Identity();
    vector += across * track.world_from_frame[i].translation() + kNoCrossing * ahead;
  }
  return solve_symmetric(matrix, vector);
}

}  // namespace dressform
