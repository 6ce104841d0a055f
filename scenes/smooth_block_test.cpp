#include "scenes/smooth_block.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace dressform {
namespace {

// Stripes of every other column, but for an even square at (30, 12) to (40, 22).
cv::Mat striped() {
  cv::Mat image(40, 60, CV_8UC3, cv::Scalar(80, 80, 80));
  for (int x = 0; x < image.cols; x += 2) image.col(x) = cv::Scalar(160, 160, 160);
  image(cv::Rect(30, 12, 11, 11)) = cv::Scalar(20, 200, 90);
  return image;
}

TEST(SmoothBlock, IsWhereTheImageIsEven) {
  const cv::Mat everywhere(40, 60, CV_8UC1, cv::Scalar(255));
  EXPECT_EQ(smoothest_block(striped(), everywhere, 11), cv::Rect(30, 12, 11, 11));
  EXPECT_EQ(smoothest_block(striped(), everywhere, 5), cv::Rect(30, 12, 5, 5)) << "the first of equals";
}

TEST(SmoothBlock, LiesWhollyInsideTheMask) {
  cv::Mat mask(40, 60, CV_8UC1, cv::Scalar(0));
  mask(cv::Rect(4, 20, 20, 9)) = 255;
  mask.at<std::uint8_t>(20, 4) = 0;
  const cv::Rect block = smoothest_block(striped(), mask, 7);
  EXPECT_EQ(block.area(), 49);
  EXPECT_EQ(cv::countNonZero(mask(block)), 49);
  EXPECT_TRUE(smoothest_block(striped(), mask, 10).empty());
  EXPECT_TRUE(smoothest_block(striped(), cv::Mat(40, 60, CV_8UC1, cv::Scalar(0)), 3).empty());
}

}  // namespace
}  // namespace dressform
