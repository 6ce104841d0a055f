#include "pipeline/texture/noise.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

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
  EXPECT_NEAR(noise_levels(photograph(3), 20), 3, 0.5);  // no such brightness in the image
}

// Of a camera with one colour filter a pixel: interpolation smooths the noise between neighbours, which says nothing of
// how far the levels are off.
TEST(Noise, IsFoundBehindAMosaic) {
  cv::Mat raw(240, 320, CV_16UC1), image;
  for (int y = 0; y < raw.rows; ++y)
    for (int x = 0; x < raw.cols; ++x)
      raw.at<std::uint16_t>(y, x) = cv::saturate_cast<std::uint16_t>(
          256 * (120 + 5 * normal4(3, 1, static_cast<std::uint64_t>(y * raw.cols + x))[0]));
  cv::demosaicing(raw, image, cv::COLOR_BayerRGGB2BGR_EA);
  image.convertTo(image, CV_8UC3, 1.0 / 256);
  cv::Scalar mean, deviation;
  cv::meanStdDev(image, mean, deviation);
  EXPECT_NEAR(noise_levels(image, 120), (deviation[0] + deviation[1] + deviation[2]) / 3, 0.7);
}

TEST(Noise, NoneInACleanOrTinyImage) {
  EXPECT_LT(noise_levels(cv::Mat(100, 100, CV_8UC3, cv::Scalar::all(90)), 90), 1e-9);
  EXPECT_EQ(noise_levels(cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(90)), 90), 0);
}

}  // namespace
}  // namespace dressform
