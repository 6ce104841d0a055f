#include <gtest/gtest.h>

#include "pipeline/fuse/block_volume.h"
#include "pipeline/fuse/model_volume.h"
#include "pipeline/testing/fuse_scans.h"

namespace dressform {
namespace {

using fuse_test::kDegrees;
using test_scene::Figure;
using test_scene::Scan;

TEST(BlockVolume, SphereFromKnownPoses) {
  Figure ball;
  ball.parts = {{{0, 1, 0}, {.3, .3, .3}}};
  ball.floor = false;
  const SensorCalibration calibration = test_scene::kinect(0.5, 0.01);
  const Scan scan = test_scene::walk_round(ball, calibration, 30, 350, 1, 3);
  const ScanFrames frames = prepare_frames(scan.scan, calibration, 30, 4.5);
  const std::vector<char> used(30, 1);
  const BlockVolume volume(frames, calibration.ir, scan.world_from_sensor, used, {}, {});
  const PointCloud points = volume.surface_points(3);
  ASSERT_GT(points.points.size(), 10000u);
  double sum = 0;
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    const Vector3d outward = points.points[i] - Vector3d(0, 1, 0);
    sum += outward.norm() - 0.3;
    EXPECT_LT(std::abs(outward.norm() - 0.3), 0.008);
    EXPECT_GT(outward.normalized().dot(points.normals[i]), 0.5);
  }
  EXPECT_LT(std::abs(sum / points.points.size()), 3e-4);
}

// What the model of a ball shows from a place where no frame was taken.
TEST(ModelVolume, RayCastOfASphere) {
  Figure ball;
  ball.parts = {{{0, 1, 0}, {.3, .3, .3}}};
  ball.floor = false;
  ball.wall_m = 0;
  const SensorCalibration calibration = test_scene::kinect(0.5);
  const Scan scan = test_scene::walk_round(ball, calibration, 12, 40, 1, 3);
  const ScanFrames frames = prepare_frames(scan.scan, calibration, 30, 4.5);
  VolumeOptions options;
  options.voxel_m = 0.01;
  options.truncation_m = 0.04;
  ModelVolume model(calibration.ir, options);
  for (int i = 0; i < 12; ++i)
    if (i != 6) model.integrate(frames.depth_m[i], frames.maps[i], scan.world_from_sensor[i]);
  const Camera grid = frames.maps[0].camera;
  const Isometry3d& pose = scan.world_from_sensor[6];
  const DepthMap seen = model.ray_cast(grid, normalized_grid(grid), pose);
  EXPECT_GT(seen.valid, 0.8 * frames.maps[6].valid);
  double off = 0, turned = 0;
  for (std::size_t k = 0; k < seen.points.size(); ++k) {
    if (!seen.has_normal(static_cast<int>(k))) continue;
    const Vector3d outward = pose * seen.points[k].cast<double>() - Vector3d(0, 1, 0);
    off += std::abs(outward.norm() - 0.3) / seen.valid;
    turned += kDegrees *
              std::acos(std::min(1.0, outward.normalized().dot(pose.linear() * seen.normals[k].cast<double>()))) /
              seen.valid;
    EXPECT_LT(std::abs(outward.norm() - 0.3), 0.01);
  }
  EXPECT_LT(off, 0.0015);
  EXPECT_LT(turned, 8);
  // From behind, where nothing was seen, there is nothing.
  const Isometry3d behind = Isometry3d(Eigen::AngleAxisd(M_PI, Vector3d::UnitY())) * pose;
  EXPECT_LT(model.ray_cast(grid, normalized_grid(grid), behind).valid, 0.01 * seen.valid);
}

}  // namespace
}  // namespace dressform
