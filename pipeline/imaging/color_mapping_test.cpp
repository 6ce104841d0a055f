#include "pipeline/imaging/color_mapping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "scenes/error.h"

namespace dressform {
namespace {

SensorCalibration small_sensor() {
  SensorCalibration sensor;
  sensor.ir = Camera{128, 106, 92, 92, 63.5, 52.5, {0.09, -0.27, 0, 0, 0.1}};
  sensor.color = Camera{480, 270, 267, 267, 239.5, 134.5, {0.05, -0.07, 0.001, -0.001, 0.02}};
  sensor.color_from_ir.translation() = Vector3d(-0.052, 0.001, 0.002);
  return sensor;
}

// Depth of a plane z = plane_m with a nearer square block in the middle.
cv::Mat block_before_plane(const Camera& ir, float block_mm, float plane_mm) {
  cv::Mat depth(ir.height, ir.width, CV_32F, cv::Scalar(plane_mm));
  depth(cv::Rect(54, 40, 20, 26)) = block_mm;
  return depth;
}

TEST(ColorMapping, OffsetIsRemovedAndNoneStaysNone) {
  cv::Mat raw = (cv::Mat_<ushort>(1, 3) << 0, 1000, 5);
  SensorCalibration sensor;
  sensor.depth_offset_m = 0.015;
  const cv::Mat depth = corrected_depth_mm(raw, sensor);
  EXPECT_EQ(depth.at<float>(0), 0);
  EXPECT_NEAR(depth.at<float>(1), 985, 1e-3);
  EXPECT_EQ(depth.at<float>(2), 0);
}

TEST(ColorMapping, RoundTripOnAPlane) {
  const auto sensor = small_sensor();
  const cv::Mat depth(sensor.ir.height, sensor.ir.width, CV_32F, cv::Scalar(2100));
  const auto map = color_depth_map(depth, sensor);
  const cv::Mat pixels = color_of_depth_pixels(depth, sensor, &map);
  int checked = 0;
  for (int y = 10; y < 96; y += 5) {
    for (int x = 20; x < 108; x += 5) {
      const auto& uv = pixels.at<cv::Vec2f>(y, x);
      if (std::isnan(uv[0])) continue;
      const Vector3d in_color = sensor.color_from_ir * sensor.ir.unproject(Vector2d(x, y), 2.1);
      EXPECT_NEAR((sensor.color->project(in_color) - Vector2d(uv[0], uv[1])).norm(), 0, 1e-3);
      const auto& back = map.depth_pixel.at<cv::Vec2f>(cvRound(uv[1]), cvRound(uv[0]));
      EXPECT_NEAR(back[0], x, 0.3);
      EXPECT_NEAR(back[1], y, 0.3);
      ++checked;
    }
  }
  EXPECT_GT(checked, 100);
  EXPECT_NEAR(map.depth_mm.at<float>(134, 240), 2100, 0.01);
  EXPECT_NEAR(map.z_mm.at<float>(134, 240), 2102, 0.01);
}

// The colour camera stands 52 mm to the right, so what lies to the right of the block's left edge on the wall is
// hidden from it: those depth pixels must not take the block's colour.
TEST(ColorMapping, HiddenDepthPixelsGetNoColour) {
  const auto sensor = small_sensor();
  const cv::Mat depth = block_before_plane(sensor.ir, 1000, 2500);
  const auto map = color_depth_map(depth, sensor);
  const cv::Mat all = color_of_depth_pixels(depth, sensor), seen = color_of_depth_pixels(depth, sensor, &map);
  cv::Mat block = cv::Mat::zeros(depth.size(), CV_8U);
  block(cv::Rect(54, 40, 20, 26)) = 255;
  const cv::Mat color_block = to_color(block, map);
  int ghosts_before = 0, ghosts_after = 0;
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      if (block.at<uchar>(y, x)) {
        EXPECT_FALSE(std::isnan(seen.at<cv::Vec2f>(y, x)[0]));
        continue;
      }
      const auto falls_on_block = [&](const cv::Mat& pixels) {
        const auto& uv = pixels.at<cv::Vec2f>(y, x);
        return !std::isnan(uv[0]) && color_block.at<uchar>(cvRound(uv[1]), cvRound(uv[0])) == 255;
      };
      ghosts_before += falls_on_block(all);
      ghosts_after += falls_on_block(seen);
    }
  }
  EXPECT_GT(ghosts_before, 30);
  EXPECT_EQ(ghosts_after, 0);
}

TEST(ColorMapping, NoSurfaceAcrossADepthJump) {
  const auto sensor = small_sensor();
  const auto map = color_depth_map(block_before_plane(sensor.ir, 1000, 2500), sensor);
  for (int v = 0; v < map.depth_mm.rows; ++v) {
    for (int u = 0; u < map.depth_mm.cols; ++u) {
      const float depth = map.depth_mm.at<float>(v, u);
      EXPECT_TRUE(depth == 0 || std::abs(depth - 1000) < 1 || std::abs(depth - 2500) < 1) << depth;
    }
  }
}

TEST(ColorMapping, EmptyDepthGivesEmptyMap) {
  const auto sensor = small_sensor();
  const cv::Mat depth = cv::Mat::zeros(sensor.ir.height, sensor.ir.width, CV_32F);
  const auto map = color_depth_map(depth, sensor);
  EXPECT_EQ(cv::countNonZero(map.depth_mm), 0);
  EXPECT_TRUE(std::isnan(map.depth_pixel.at<cv::Vec2f>(10, 10)[0]));
  EXPECT_TRUE(std::isnan(color_of_depth_pixels(depth, sensor, &map).at<cv::Vec2f>(50, 50)[0]));
}

TEST(ColorMapping, WithoutColourCameraIsAnInputError) {
  auto sensor = small_sensor();
  sensor.color.reset();
  EXPECT_THROW(color_depth_map(cv::Mat::zeros(106, 128, CV_32F), sensor), InputError);
}

}  // namespace
}  // namespace dressform
