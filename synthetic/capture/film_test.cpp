#include "synthetic/capture/film.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <opencv2/imgproc.hpp>

#include "synthetic/capture/texture_pyramid.h"

namespace dressform {
namespace {

FilmSpec noiseless() {
  FilmSpec film;
  film.electrons_full_scale = 1e12f;
  film.read_noise_electrons = 0;
  film.jpeg_quality = 0;
  return film;
}

cv::Mat even(float r, float g, float b, cv::Size size = {64, 48}) { return {size, CV_32FC3, cv::Scalar(r, g, b)}; }

double level(float linear) { return 255.0 * srgb_from_linear(linear); }

double psnr(const cv::Mat& a, const cv::Mat& b) { return cv::PSNR(a, b); }

TEST(Film, EvenLightKeepsItsColourThroughTheMosaic) {
  for (const bool mosaic : {false, true}) {
    FilmSpec film = noiseless();
    film.mosaic = mosaic;
    const cv::Mat image = developed(even(0.6f, 0.25f, 0.05f), film, 1);
    for (int y = 0; y < image.rows; ++y)
      for (int x = 0; x < image.cols; ++x) {
        const auto& bgr = image.at<cv::Vec3b>(y, x);
        ASSERT_NEAR(bgr[2], level(0.6f), 0.7) << "mosaic " << mosaic << ' ' << x << ' ' << y;
        ASSERT_NEAR(bgr[1], level(0.25f), 0.7) << "mosaic " << mosaic;
        ASSERT_NEAR(bgr[0], level(0.05f), 0.7) << "mosaic " << mosaic;
      }
  }
}

TEST(Film, WhiteBalanceMultipliesAndBlownLightIsWhite) {
  FilmSpec film = noiseless();
  film.white_balance = {1.05f, 1.0f, 0.95f};
  const auto balanced = developed(even(0.4f, 0.4f, 0.4f), film, 1).at<cv::Vec3b>(20, 20);
  EXPECT_NEAR(balanced[2], level(0.42f), 0.7);
  EXPECT_NEAR(balanced[0], level(0.38f), 0.7);
  EXPECT_EQ(developed(even(3, 3, 3), film, 1).at<cv::Vec3b>(20, 20), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(developed(even(0, 0, 0), film, 1).at<cv::Vec3b>(20, 20), cv::Vec3b(0, 0, 0));
}

// Electrons N give sqrt(N + read^2); without the mosaic every channel has its own.
TEST(Film, NoiseIsThatOfTheElectronsCounted) {
  FilmSpec film;
  film.mosaic = false;
  film.jpeg_quality = 0;
  for (const float gain : {1.0f, 4.0f}) {
    film.gain = gain;
    film.electrons_full_scale = 2500 / gain;
    const float linear = 0.5f / gain;  // behind the gain: 0.5
    cv::Mat image = developed(even(linear, linear, linear, {400, 300}), film, 7);
    cv::Scalar mean, deviation;
    cv::meanStdDev(image, mean, deviation);
    const double electrons = 2500 * linear, sigma = std::sqrt(electrons + 9) * gain / 2500;
    const double slope = (level(0.51f) - level(0.49f)) / 0.02;
    EXPECT_NEAR(deviation[1], std::hypot(slope * sigma, 0.29), 0.06 * slope * sigma) << "gain " << gain;
  }
}

// What one filter a pixel costs: nothing along a straight edge but its colour fringe, and most in the finest detail.
TEST(Film, TheMosaicBlursFineDetailAndLittleElse) {
  cv::Mat edge = even(0.1f, 0.1f, 0.1f), lines = even(0.1f, 0.1f, 0.1f);
  edge.colRange(32, 64).setTo(cv::Scalar(0.5f, 0.5f, 0.5f));
  for (int x = 0; x < 64; x += 2) lines.col(x).setTo(cv::Scalar(0.5f, 0.3f, 0.1f));
  FilmSpec film = noiseless(), whole = noiseless();
  whole.mosaic = false;
  const double at_edge = psnr(developed(edge, film, 1), developed(edge, whole, 1));
  const double at_lines = psnr(developed(lines, film, 1), developed(lines, whole, 1));
  EXPECT_GT(at_edge, 30);
  EXPECT_LT(at_lines, 25);
}

TEST(Film, JpegLosesWhatItsQualitySays) {
  cv::Mat light = even(0.3f, 0.3f, 0.3f, {320, 240});
  for (int y = 0; y < light.rows; ++y)
    for (int x = 0; x < light.cols; ++x)
      light.at<cv::Vec3f>(y, x) = {0.3f + 0.2f * std::sin(x * 0.3f), 0.3f + 0.2f * std::sin(y * 0.2f), 0.2f};
  FilmSpec film = noiseless();
  const cv::Mat exact = developed(light, film, 1);
  double before = 1e9;
  for (const int quality : {98, 90, 50, 10}) {
    film.jpeg_quality = quality;
    const double now = psnr(developed(light, film, 1), exact);
    EXPECT_LT(now, before) << quality;
    if (quality == 90) {
      EXPECT_GT(now, 33);
    }
    before = now;
  }
  EXPECT_LT(before, 33);
}

TEST(Film, SameBytesForAnyThreadCountAndSeedsDiffer) {
  const cv::Mat light = even(0.3f, 0.2f, 0.1f, {333, 207});
  cv::Mat images[2];
  for (int threads = 1; threads <= 2; ++threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    images[threads - 1] = developed(light, {}, 1);
  }
  EXPECT_EQ(cv::norm(images[0], images[1], cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(images[0], developed(light, {}, 2), cv::NORM_INF), 0);
}

}  // namespace
}  // namespace dressform
