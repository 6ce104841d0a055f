#include "pipeline/texture/noise.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "scenes/random.h"

namespace dressform {
namespace {

// Left half a plain wall, right half a busy weave of contrast 40; noise of 3 levels everywhere.
cv::Mat photograph(double sigma) {
  cv::Mat color(240, 320, CV_8UC3);
  for (int y = 0; y < color.rows; ++y)
    for (int x = 0; x < color.cols; ++x) {
      const double weave = x >= 160 ? 20 * (((x / 2) ^ (y / 2)) % 2 ? 1 : -1) : 0;
      const auto noise = normal4(3, 1, static_cast<std::uint64_t>(y * color.cols + x));
      for (int c = 0; c < 3; ++c)
        color.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uchar>(120 + 0.1 * x + weave + sigma * noise[c]);
    }
  return color;
}

TEST(Noise, IsTakenFromTheSmoothPartNotFromTheWeave) {
  EXPECT_NEAR(noise_levels(photograph(3), 130), 3, 0.5);
  EXPECT_NEAR(noise_levels(photograph(6), 130), 6, 0.9);
  EXPECT_NEAR(noise_levels(photograph(3), 20), 3, 0.5);  // no such brightness in the picture
}

TEST(Noise, NoneInACleanOrTinyPicture) {
  EXPECT_LT(noise_levels(cv::Mat(100, 100, CV_8UC3, cv::Scalar::all(90)), 90), 1e-9);
  EXPECT_EQ(noise_levels(cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(90)), 90), 0);
}

}  // namespace
}  // namespace dressform
