#include "eval/metrics/label_metrics.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace dressform::metrics {
namespace {

TEST(LabelMetrics, Overlap) {
  cv::Mat truth(100, 100, CV_8UC1, cv::Scalar(0)), estimate = truth.clone();
  truth(cv::Rect(20, 20, 40, 40)) = 2;
  estimate(cv::Rect(30, 20, 40, 40)) = 2;
  EXPECT_NEAR(label_iou(estimate, truth, 2), 30.0 / 50, 1e-12);
  EXPECT_EQ(label_iou(truth, truth, 2), 1);
  EXPECT_EQ(label_iou(truth, truth, 3), 1) << "empty in both";
  EXPECT_EQ(label_iou(truth, truth * 0, 2), 0);
  EXPECT_NEAR(foreground_leakage(estimate, truth), 0.25, 1e-12);
  EXPECT_NEAR(foreground_miss(estimate, truth), 0.25, 1e-12);
  EXPECT_EQ(foreground_leakage(truth * 0, truth), 0);
}

TEST(LabelMetrics, Outlines) {
  cv::Mat truth(100, 100, CV_8UC1, cv::Scalar(0)), shifted = truth.clone(), off = truth.clone();
  truth(cv::Rect(20, 20, 40, 40)) = 1;
  shifted(cv::Rect(22, 20, 40, 40)) = 1;
  off(cv::Rect(24, 24, 40, 40)) = 1;
  EXPECT_EQ(boundary_f(truth, truth, 1), 1);
  EXPECT_EQ(boundary_f(shifted, truth, 1, 2), 1) << "two pixels are within tolerance";
  EXPECT_LT(boundary_f(off, truth, 1, 2), 0.2);
  EXPECT_EQ(boundary_f(truth * 0, truth, 1), 0);
  EXPECT_EQ(boundary_f(truth * 0, truth * 0, 1), 1);
}

}  // namespace
}  // namespace dressform::metrics
