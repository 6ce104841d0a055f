#include "eval/inspect/depth_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "eval/inspect/depth_edges.h"
#include "eval/testing/noisy_plane.h"

namespace dressform {
namespace {

TEST(SmoothWindows, DeviationDistanceAndAngleAreFound) {
  for (const double tilt_deg : {0.0, 40.0}) {
    const auto windows = smooth_windows(noisy_plane(2, tilt_deg, 6, 3), half_size_kinect());
    ASSERT_GE(windows.size(), 150u);  // of 238
    EXPECT_NEAR(median_sigma_mm(windows), 6, 0.15);
    for (const auto& window : windows) {
      const Vector2d at = half_size_kinect().normalized({window.pixels.x + 7.0, window.pixels.y + 7.0});
      const double tilt = tilt_deg * M_PI / 180;
      const Vector3d normal(-std::sin(tilt), 0, std::cos(tilt)), ray = Vector3d(at.x(), at.y(), 1).normalized();
      EXPECT_NEAR(window.theta_rad, std::acos(std::abs(normal.dot(ray))), 0.06);
      EXPECT_NEAR(window.z_m,
                  true_plane_depth(half_size_kinect(), window.pixels.x + 7, window.pixels.y + 7, 2, tilt_deg), 0.01);
      EXPECT_NEAR(window.products_mm2[1] / window.products_mm2[0], 0, 0.3);  // neighbours share nothing
    }
  }
}

TEST(SmoothWindows, NoneWhereSurfacesBendStepOrHaveHoles) {
  cv::Mat depth = noisy_plane(2, 0, 1, 5);
  for (int y = 0; y < depth.rows; ++y)
    for (int x = 0; x < depth.cols; ++x) {
      auto& mm = depth.at<std::uint16_t>(y, x);
      if (y < 60) mm = static_cast<std::uint16_t>(mm + 0.4 * std::pow(x % 15 - 7, 2));  // bends
      if (y >= 60 && y < 120 && x % 15 > 9) mm += 40;                                   // steps
      if (y >= 120 && y < 180 && x % 15 == 3 && y % 15 == 3) mm = 0;                    // holes
    }
  for (const auto& window : smooth_windows(depth, half_size_kinect())) EXPECT_GE(window.pixels.y, 180);
  EXPECT_TRUE(smooth_windows(cv::Mat::zeros(212, 256, CV_16UC1), half_size_kinect()).empty());
  EXPECT_TRUE(smooth_windows(cv::Mat::zeros(9, 9, CV_16UC1), Camera{9, 9, 8, 8, 4, 4, {}}).empty());
  EXPECT_TRUE(std::isnan(median_sigma_mm({})));
}

TEST(WindowsOverTime, WhatStandsStillDoesNotCount) {
  const cv::Mat rough = noisy_plane(2, 20, 3, 1), flat = noisy_plane(2, 20, 0, 0);
  std::vector<cv::Mat> frames;
  for (int i = 0; i < 8; ++i) {
    cv::Mat noise, rough_values, frame;
    cv::subtract(noisy_plane(2, 20, 5, 10 + i), flat, noise, cv::noArray(), CV_32S);
    rough.convertTo(rough_values, CV_32S);
    cv::Mat(rough_values + noise).convertTo(frame, CV_16U);
    frames.push_back(frame);
  }
  const auto windows = windows_over_time(frames, half_size_kinect());
  ASSERT_GE(windows.size(), 100u);
  EXPECT_NEAR(median_sigma_mm(windows), 5, 0.1);
  EXPECT_TRUE(windows_over_time({rough}, half_size_kinect()).empty());
}

TEST(WindowsOverTime, TwoFramesAndWhatMovedBetweenThem) {
  cv::Mat first = noisy_plane(2, 0, 4, 21), second = noisy_plane(2, 0, 4, 22);
  second(cv::Rect(0, 0, 256, 100)) += 30;
  const auto windows = windows_over_time({first, second}, half_size_kinect());
  ASSERT_GE(windows.size(), 60u);
  EXPECT_NEAR(median_sigma_mm(windows), 4, 0.15);
  for (const auto& window : windows) EXPECT_GE(window.pixels.y, 90);
}

TEST(StillRuns, WhereTheSensorStood) {
  std::vector<cv::Mat> frames;
  for (int i = 0; i < 4; ++i) frames.push_back(noisy_plane(2 + 0.1 * i, 10, 2, i));
  for (int i = 0; i < 6; ++i) frames.push_back(noisy_plane(3, 10, 3, 10 + i));
  for (int i = 0; i < 3; ++i) frames.push_back(noisy_plane(1.5 + 0.1 * i, 30, 2, 20 + i));
  const auto runs = still_runs(frames);
  ASSERT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs[0].first, 4);
  EXPECT_EQ(runs[0].frames, 6);
  EXPECT_TRUE(still_runs({}).empty());
  EXPECT_TRUE(still_runs(std::vector<cv::Mat>(9, cv::Mat::zeros(50, 50, CV_16UC1))).empty());
}

TEST(DepthEdges, FlyingAndLostPixelsOfACrossing) {
  cv::Mat depth(10, 40, CV_16UC1, cv::Scalar(2000));
  depth.colRange(20, 40) = 3000;
  depth.at<std::uint16_t>(1, 20) = 2500;                                         // flying
  depth.at<std::uint16_t>(2, 19) = 2400, depth.at<std::uint16_t>(2, 20) = 2700;  // two
  depth.at<std::uint16_t>(3, 20) = 0;                                            // lost
  depth.row(4).colRange(14, 30) = 0;                                             // too wide to be one edge
  depth.row(5) = 2000;                                                           // no edge
  std::vector<DepthEdges> edges;
  count_edges(depth, edges);
  ASSERT_EQ(edges.size(), 5u);
  EXPECT_EQ(edges[3].from_m, 0.8);
  EXPECT_EQ(edges[3].crossings, 8);
  EXPECT_EQ(edges[3].flying, 3);
  EXPECT_EQ(edges[3].lost, 1);
  for (const int other : {0, 1, 2, 4}) EXPECT_EQ(edges[other].crossings, 0);
}

}  // namespace
}  // namespace dressform
