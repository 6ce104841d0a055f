#include "synthetic/body/body_tracking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "synthetic/capture/shapes.h"

namespace dressform {
namespace {

Camera kinect() { return Camera{256, 212, 183, 183, 127.5, 105.5, {0.09, -0.27, 0, 0, 0.1}}; }

RayScene ball_before_wall() {
  std::vector<RaySurface> surfaces(2);
  surfaces[0].mesh = sphere_mesh({0, 0, 2}, 0.4, 60);
  surfaces[0].label = Label::skin;
  surfaces[1].mesh = grid_mesh({-6, 6, 4}, {12, 0, 0}, {0, -12, 0}, 1);
  return RayScene(std::move(surfaces));
}

TEST(BodyTracking, IndexIsTheSilhouetteGiveOrTakeItsOutline) {
  const RayScene scene = ball_before_wall();
  const Camera camera = kinect();
  const RayTable rays(camera);
  const IrView view(scene, rays, camera, Isometry3d::Identity(), 0);
  for (Seed seed = 1; seed <= 4; ++seed) {
    const cv::Mat index = track_body_index(view, seed);
    const int slot = index.at<std::uint8_t>(106, 128);
    EXPECT_LT(slot, 6);
    int differing = 0;
    for (int y = 0; y < index.rows; ++y)
      for (int x = 0; x < index.cols; ++x) {
        const int value = index.at<std::uint8_t>(y, x);
        ASSERT_TRUE(value == slot || value == 255);
        const double angle = std::atan(camera.normalized({static_cast<double>(x), static_cast<double>(y)}).norm());
        const double beyond_px = (angle - std::asin(0.2)) * camera.fx;
        differing += (value == slot) != (beyond_px < 0);
        if (std::abs(beyond_px) > 6) {
          ASSERT_EQ(value == slot, beyond_px < 0);
        }
      }
    EXPECT_GT(differing, 5);    // the outline of the SDK is never exact
    EXPECT_LT(differing, 230);  // 1 px all round
  }
}

TEST(BodyTracking, JointsAreInTheCameraFrameAndNearlyRight) {
  const RayScene scene = ball_before_wall();
  const Camera camera = kinect();
  const RayTable rays(camera);
  Isometry3d world_from_sensor = Isometry3d::Identity();
  world_from_sensor.linear() << -1, 0, 0, 0, -1, 0, 0, 0, 1;
  world_from_sensor.translation() = Vector3d(0, 1.2, -2);
  const IrView view(scene, rays, camera, world_from_sensor, 0);
  Body body;
  for (const auto& name : joint_names()) body.joints[name] = Vector3d(0.1, 1.0, 0);
  body.joints["Head"] = Vector3d(0, 5, 0);  // far above the image
  const Skeleton skeleton = track_skeleton(body, view, 1);
  ASSERT_EQ(skeleton.size(), joint_names().size());
  for (const auto& [name, joint] : skeleton) {
    if (name == "Head") continue;
    EXPECT_LT((joint.position - Vector3d(-0.1, 0.2, 2)).norm(), 0.06);
    EXPECT_TRUE(joint.tracked);
  }
  EXPECT_FALSE(skeleton.at("Head").tracked);
}

}  // namespace
}  // namespace dressform
