#pragma once
#include <functional>
#include <optional>
#include <string>

#include "pipeline/fuse/fuse_scan.h"

namespace dressform {

// How far the line of sight went round the vertical through a walk, degrees: the widest span, turns added up. 360 and
// more is all round; near 0, nothing turned.
double turned_deg(const Track& track, const Vector3d& up);

// What changes before a sensor that stands still: pixels whose depth comes and goes by more than a step, as the outline
// of someone who turns does, beside pixels that stay. Up to which depth the moving thing reaches, metres; nothing where
// nothing moves, or nothing stays, or the two are not apart.
std::optional<double> depth_of_moving(const DepthScan& scan, const SensorCalibration& calibration);

// A scan that was followed, and what was taken for the body.
struct FollowedScan {
  ScanFrames frames;
  Track track;
  FuseScanOptions options;  // with the depth that was looked at
  double turned_deg = 0;
  std::string note;  // what was found, where it was not simply a walk round; empty: it was
};

// Follows the walk. Where nothing turned, but something moves before a room that stands still, that is the body: the
// scan is followed again by what moves alone. Throws InputError as checked_frames does.
using Follow = std::function<Track(const ScanFrames&, const Projector&)>;
FollowedScan followed_scan(const DepthScan& scan, const SensorCalibration& calibration, const FuseScanOptions& options,
                           const Follow& follow);

// The stage's result: converged where the walk was followed and went far enough round.
BodyModel fuse_followed(const DepthScan& scan, const SensorCalibration& calibration, const FollowedScan& followed);

}  // namespace dressform
