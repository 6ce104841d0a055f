#include "pipeline/fuse/track.h"

#include <gtest/gtest.h>

#include "pipeline/fuse/align_frames.h"
#include "pipeline/testing/fuse_scans.h"

namespace dressform {
namespace {

using namespace fuse_test;
using test_scene::Scan;

TEST(AlignFrames, RecoversAKnownMotion) {
  const SensorCalibration calibration = test_scene::kinect(0.5);
  const Scan scan = test_scene::walk_round(test_scene::standing_figure(), calibration, 3, 6, 0, 1);
  const ScanFrames frames = prepare_frames(scan.scan, calibration, 30, 4.5);
  const Projector projector(frames.maps[0].camera);
  Vector6d off;
  off << 0.02, -0.01, 0.015, 0.02, -0.015, 0.01;
  const auto found = align_to_frames(frames, projector, 1, {0, 2}, scan.world_from_sensor,
                                     exponential(off) * scan.world_from_sensor[1], {{0.1, 0.6, 1}, {0.02, 0.8, 1}}, 15);
  ASSERT_TRUE(found.converged);
  const Isometry3d error = scan.world_from_sensor[1].inverse() * found.world_from_frame;
  EXPECT_LT(error.translation().norm(), 0.002);
  EXPECT_LT(kDegrees * Eigen::AngleAxisd(error.linear()).angle(), 0.06);
}

TEST(AlignFrames, DoesNotConvergeOnNothing) {
  const SensorCalibration calibration = test_scene::kinect(0.25);
  Scan scan = test_scene::walk_round(test_scene::standing_figure(), calibration, 2, 6, 0, 1);
  const ScanFrames frames = prepare_frames(scan.scan, calibration, 30, 4.5);
  const Isometry3d away = scan.world_from_sensor[0] * Eigen::AngleAxisd(M_PI, Vector3d::UnitY());
  EXPECT_FALSE(align_to_frames(frames, Projector(frames.maps[0].camera), 1, {0}, scan.world_from_sensor, away,
                               {{0.02, 0.8, 1}}, 5)
                   .converged);
}

TEST(Track, WalkRoundIsFollowedAndItsLoopClosed) {
  const SensorCalibration calibration = test_scene::kinect(0.25, -0.015);
  const ScanFrames frames = prepare_frames(noisy_scan().scan, calibration, 30, 4.5);
  const Projector projector(frames.maps[0].camera);
  const Track open = track_odometry(frames, projector);
  EXPECT_EQ(open.count_tracked(), 120);
  const Track closed = close_loop(frames, projector, open);
  EXPECT_TRUE(closed.loop_found);
  EXPECT_GT(closed.loop_closure_m, 0);
  EXPECT_LT(pose_errors(closed.world_from_frame, noisy_scan().world_from_sensor).largest_m, 0.02);
  EXPECT_LT((axes_crossing(closed) - closed.world_from_frame[0] * Vector3d(0, 0, 1.9)).norm(), 0.15);
}

}  // namespace
}  // namespace dressform
