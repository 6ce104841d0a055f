#include "scenes/camera.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

namespace dressform {
namespace {

Camera kinect_ir() { return {512, 424, 366.38, 367.14, 255.65, 203.98, {.1095, -.3146, -.00126, -.00072, .1257}}; }
Camera kinect_color() {
  return {1920, 1080, 1059.95, 1053.93, 954.88, 523.74, {.0563, -.0742, .00143, -.00170, .0241}};
}
Camera folding() { return {512, 424, 366, 366, 255, 204, {.09, -.15, 0, 0, 0}}; }

TEST(Camera, ProjectsAsOpenCvDoes) {
  for (const Camera& camera : {kinect_ir(), kinect_color()}) {
    const std::vector<cv::Point3d> points{{0, 0, 2}, {0.9, -0.4, 1.9}, {-1.2, 1.0, 2.1}, {0.3, 0.8, 1.3}};
    const cv::Matx33d k(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
    std::vector<cv::Point2d> expected;
    cv::projectPoints(points, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), k, camera.distortion, expected);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector2d pixel = camera.project({points[i].x, points[i].y, points[i].z});
      EXPECT_NEAR(pixel.x(), expected[i].x, 1e-9);
      EXPECT_NEAR(pixel.y(), expected[i].y, 1e-9);
    }
  }
}

TEST(Camera, UnprojectInvertsProjectAllOverTheImage) {
  for (const Camera& camera : {kinect_ir(), kinect_color(), folding(), kinect_ir().scaled(0.3)})
    for (int y = -1; y <= camera.height; y += std::max(1, camera.height / 60))
      for (int x = -1; x <= camera.width; x += std::max(1, camera.width / 60)) {
        const Vector2d back = camera.project(camera.unproject({x, y}, 2.1));
        ASSERT_LT((back - Vector2d(x, y)).norm(), 1e-9) << x << " " << y;
      }
}

TEST(Camera, UnprojectGivesTheDepthAsked) {
  EXPECT_DOUBLE_EQ(kinect_ir().unproject({3, 400}, 1.7).z(), 1.7);
  const Camera plain{640, 480, 500, 510, 320, 240, {}};
  EXPECT_TRUE(plain.unproject({420, 342}, 2).isApprox(Vector3d(0.4, 0.4, 2)));
}

TEST(Camera, DirectionsBeyondTheFoldStayOutsideTheImage) {
  const Camera camera = folding();
  for (double r = 1.17; r < 4; r += 0.1)
    for (double angle = 0; angle < 6.28; angle += 0.1)
      EXPECT_FALSE(camera.contains(camera.project({r * std::cos(angle), r * std::sin(angle), 1}))) << r;
}

TEST(Camera, UnreachablePixelsGiveAFiniteDirection) {
  Camera camera = folding();
  camera.distortion = {-0.6, 0, 0, 0, 0};  // folds inside the image
  EXPECT_TRUE(camera.normalized({0, 0}).allFinite());
  EXPECT_LT(camera.normalized({0, 0}).norm(), 1);
}

TEST(Camera, ScalingKeepsTheImageCorners) {
  const Camera camera = kinect_ir(), half = camera.scaled(0.5);
  EXPECT_EQ(half.width, 256);
  EXPECT_EQ(half.height, 212);
  const Vector3d corner = camera.unproject({-0.5, -0.5}, 1), opposite = camera.unproject({511.5, 423.5}, 1);
  EXPECT_LT((half.project(corner) - Vector2d(-0.5, -0.5)).norm(), 1e-9);
  EXPECT_LT((half.project(opposite) - Vector2d(255.5, 211.5)).norm(), 1e-9);
  EXPECT_EQ(camera.scaled(1e-9).width, 1);
}

TEST(Camera, GridHoldsEveryPixelsDirection) {
  const Camera camera = kinect_ir().scaled(0.1);
  const cv::Mat grid = normalized_grid(camera);
  ASSERT_EQ(grid.type(), CV_64FC2);
  ASSERT_EQ(grid.size(), cv::Size(camera.width, camera.height));
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.cols; ++x) {
      const auto cell = grid.at<cv::Vec2d>(y, x);
      EXPECT_EQ(Vector2d(cell[0], cell[1]), camera.normalized({x, y}));
    }
}

}  // namespace
}  // namespace dressform
