#include "synthetic/sensors/bounce_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "synthetic/sensors/kinect_v2_scenes.h"

// Light that reaches a Kinect v2 by way of other surfaces.
namespace dressform {
namespace {

using namespace kinect_v2_scenes;

TEST(KinectV2, ACornerLooksRoundBecauseOfBouncedLight) {
  // Two bright walls at a right angle, edge at 2.5 m: light that bounced off the other wall came the longer way.
  std::vector<RaySurface> walls;
  walls.push_back(surface(grid_mesh({0, -2, 2.5}, {2, 0, -2}, {0, 4, 0}, 0.1), 0.8f));
  walls.push_back(surface(grid_mesh({0, -2, 2.5}, {0, 4, 0}, {-2, 0, -2}, 0.1), 0.8f));
  const RayScene scene(std::move(walls));
  const auto depth = [&](double strength, int x) {
    const cv::Mat part = shoot_v2(scene, noiseless_v2({{"multipath", strength}})).depth_mm(cv::Rect(x, 192, 1, 40));
    return cv::mean(part)[0];
  };
  for (const int x : {225, 286}) {
    const double longer_mm = depth(1, x) - depth(0, x);
    EXPECT_GT(longer_mm, 5) << x;
    EXPECT_LT(longer_mm, 80) << x;
  }
}

// From the centre of a matt sphere: what bounces once lights all of it alike, albedo x cone / (4 pi) of the direct.
void expect_light_in_a_sphere(const Camera& camera) {
  const RayScene scene = scene_of(surface(sphere_mesh({0, 0, 0}, 2, 200), 0.5f, true));
  const RayTable rays(camera);
  const IrView view(scene, rays, camera, Isometry3d::Identity(), 0);
  const BounceMap map(view, 4, 1);
  const int width = camera.width, height = camera.height;
  double cone = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      cone += std::pow(1 + view.ideal(x, y).squaredNorm(), -1.5) / (camera.fx * camera.fy);
  std::vector<float> terms(width * tof::bounce_terms), depth(width);
  for (const int y : {0, height / 4, height / 2, height - 1}) {
    for (int x = 0; x < width; ++x) depth[x] = static_cast<float>(2 / std::sqrt(1 + view.ideal(x, y).squaredNorm()));
    map.row(y, depth.data(), terms.data());
    for (const int x : {0, 2 * width / 5, width / 2, width - 1})
      EXPECT_NEAR(terms[width * (tof::bounce_terms - 1) + x], 0.5 * cone / (4 * M_PI) / 4,
                  0.05 * 0.5 * cone / (16 * M_PI));
  }
}

TEST(KinectV2, BouncedLightInASphereIsThatOfTheBooks) {
  expect_light_in_a_sphere({512, 424, 366, 366, 255.5, 211.5, {}});
}

TEST(KinectV2, BouncedLightIsThatOfTheBooksInSmallImagesToo) {
  expect_light_in_a_sphere({307, 254, 219.6, 219.6, 153, 126.5, {}});
  expect_light_in_a_sphere({103, 85, 73.2, 73.2, 51, 42, {}});
}

TEST(KinectV2, LightThatReachesAWallDoesNotReachThePostBeforeIt) {
  // A post faces the lens before a niche of two bright walls: nothing lit can be seen from its front.
  std::vector<RaySurface> walls;
  walls.push_back(surface(grid_mesh({0, -2, 2.7}, {0.5, 0, -0.5}, {0, 4, 0}, 0.1), 0.8f));
  walls.push_back(surface(grid_mesh({0, -2, 2.7}, {0, 4, 0}, {-0.5, 0, -0.5}, 0.1), 0.8f));
  walls.push_back(surface(grid_mesh({-0.06, -2, 2.0}, {0, 4, 0}, {0.12, 0, 0}, 0.05), 0.4f));
  const RayScene scene(std::move(walls));
  const cv::Mat with = shoot_v2(scene, noiseless_v2({{"multipath", 1.0}})).depth_mm,
                without = shoot_v2(scene, noiseless_v2()).depth_mm;
  for (int x = 248; x <= 263; ++x) {
    ASSERT_NEAR(without.at<std::uint16_t>(212, x), 2000, 5) << x;
    EXPECT_NEAR(with.at<std::uint16_t>(212, x), without.at<std::uint16_t>(212, x), 1) << x;
  }
}

TEST(KinectV2, APlaneBouncesNoLightOntoItself) {
  const RayScene scene = scene_of(plane(2, 30, 0.8f));
  EXPECT_EQ(cv::norm(shoot_v2(scene, noiseless_v2()).depth_mm,
                     shoot_v2(scene, noiseless_v2({{"multipath", 1.0}})).depth_mm, cv::NORM_INF),
            0);
}

}  // namespace
}  // namespace dressform
