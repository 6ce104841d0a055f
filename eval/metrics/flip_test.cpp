#include "eval/metrics/flip.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace dressform::metrics {
namespace {

cv::Mat plain_color(int blue, int green, int red) { return cv::Mat(40, 50, CV_8UC3, cv::Scalar(blue, green, red)); }

cv::Mat with_square(int side, int level) {
  cv::Mat image = plain_color(128, 128, 128);
  cv::rectangle(image, cv::Rect(20, 16, side, side), cv::Scalar::all(level), cv::FILLED);
  return image;
}

TEST(Flip, EqualImagesDoNotDiffer) { EXPECT_EQ(flip_mean(with_square(8, 20), with_square(8, 20)), 0); }

// By the paper's formulas on L* = 0 and 100: 100^0.7 = 25.12; the largest, green to blue, 203.3^0.7 = 41.28; bent:
// .95 + (25.12 - 16.51) / 24.77 * .05 = .967. Plain images have no edges, so this is all.
TEST(Flip, BlackAgainstWhiteIsTheNumberOfTheFormulas) {
  EXPECT_NEAR(flip_mean(plain_color(0, 0, 0), plain_color(255, 255, 255)), 0.967, 0.001);
}

TEST(Flip, GreenAgainstBlueIsTheLargestDifference) {
  EXPECT_NEAR(flip_mean(plain_color(0, 255, 0), plain_color(255, 0, 0)), 1, 1e-6);
}

TEST(Flip, IsSymmetricAndWithinZeroAndOne) {
  const cv::Mat a = with_square(8, 20), b = with_square(8, 240);
  cv::Mat difference;
  cv::absdiff(flip_map(a, b), flip_map(b, a), difference);
  EXPECT_EQ(cv::countNonZero(difference), 0);
  double least = 0, most = 0;
  cv::minMaxLoc(flip_map(a, b), &least, &most);
  EXPECT_GE(least, 0);
  EXPECT_LE(most, 1);
}

TEST(Flip, GrowsWithLevelAndWithSize) {
  const cv::Mat grey = plain_color(128, 128, 128);
  EXPECT_GT(flip_mean(grey, with_square(8, 160)), flip_mean(grey, with_square(8, 136)));
  EXPECT_GT(flip_mean(grey, with_square(12, 160)), flip_mean(grey, with_square(8, 160)));
}

// A sharp square makes edges that the same change of level without edges does not have.
TEST(Flip, AnEdgeCountsMoreThanItsColour) {
  const cv::Mat map = flip_map(plain_color(128, 128, 128), with_square(20, 160));
  const double plain = flip_mean(plain_color(128, 128, 128), plain_color(160, 160, 160));
  EXPECT_GT(map.at<float>(20, 20), 1.1 * plain) << "at the square's left edge";
}

// Seen from afar a fine pattern is grey: far fewer pixels per degree would show it.
TEST(Flip, FinePatternsMatterLessFromAfar) {
  cv::Mat stripes = plain_color(128, 128, 128);
  for (int x = 0; x < stripes.cols; ++x) stripes.col(x).setTo(cv::Scalar::all(x % 2 ? 140 : 116));
  const cv::Mat grey = plain_color(128, 128, 128);
  EXPECT_LT(flip_mean(grey, stripes, 67), flip_mean(grey, stripes, 10));
}

TEST(Flip, RefusesImagesThatCannotBeCompared) {
  EXPECT_THROW(flip_map(cv::Mat(3, 3, CV_8UC3), cv::Mat(3, 4, CV_8UC3)), std::invalid_argument);
  EXPECT_THROW(flip_map(cv::Mat(3, 3, CV_8UC1), cv::Mat(3, 3, CV_8UC1)), std::invalid_argument);
}

}  // namespace
}  // namespace dressform::metrics
