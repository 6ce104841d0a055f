#include "pipeline/surface/depth_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/random.h"

namespace dressform {
namespace {

// Two upright limbs of 7 cm radius, 2 m away, on the Kinect v2's grid; `sigma_mm` of white noise.
cv::Mat limbs(double sigma_mm, std::uint64_t seed) {
  cv::Mat image(424, 512, CV_32F, cv::Scalar(0));
  constexpr double pixel_mm = 5.5, radius_mm = 70;
  for (int y = 150; y < 400; ++y)
    for (int x = 200; x < 300; ++x) {
      const double across = pixel_mm * (std::abs(x - 250) - 22);
      if (std::abs(across) > 0.9 * radius_mm) continue;
      const double noise = sigma_mm * normal4(seed, 1, static_cast<std::uint64_t>(y) * 512 + x)[0];
      image.at<float>(y, x) = static_cast<float>(2000 + 0.3 * (y - 250) + radius_mm -
                                                 std::sqrt(radius_mm * radius_mm - across * across) + noise);
    }
  return image;
}

TEST(DepthNoise, ComesBackFromBentSurfaces) {
  for (const double sigma : {0.0, 1.0, 2.5, 5.0})
    EXPECT_NEAR(depth_noise_mm({limbs(sigma, 1), limbs(sigma, 2)}, 60), sigma, 0.06 * sigma + 0.05) << sigma;
}

TEST(DepthNoise, SaysNothingWithoutASurface) {
  EXPECT_EQ(depth_noise_mm({}, 25), 0);
  EXPECT_EQ(depth_noise_mm({cv::Mat(3, 2, CV_32F, cv::Scalar(2000)), cv::Mat()}, 25), 0);
  EXPECT_EQ(depth_noise_mm({cv::Mat(424, 512, CV_32F, cv::Scalar(0))}, 25), 0);
}

}  // namespace
}  // namespace dressform
