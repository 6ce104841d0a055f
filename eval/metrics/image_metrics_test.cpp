#include "eval/metrics/image_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace dressform::metrics {
namespace {

TEST(ImageMetrics, Psnr) {
  const cv::Mat a(20, 20, CV_8UC3, cv::Scalar(100, 100, 100)), b(20, 20, CV_8UC3, cv::Scalar(110, 100, 100));
  const cv::Mat all(20, 20, CV_8UC1, cv::Scalar(255));
  EXPECT_NEAR(psnr_db(a, b, all), 10 * std::log10(255.0 * 255 * 3 / 100), 1e-9);
  EXPECT_TRUE(std::isinf(psnr_db(a, a, all)));
  EXPECT_TRUE(std::isnan(psnr_db(a, b, all * 0)));
}

// The definition, window by window.
double ssim_at(const cv::Mat& a, const cv::Mat& b, int cx, int cy) {
  double weights = 0, ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
  for (int y = -5; y <= 5; ++y)
    for (int x = -5; x <= 5; ++x) {
      const double w = std::exp(-(x * x + y * y) / (2 * 1.5 * 1.5));
      const double p = a.at<unsigned char>(cy + y, cx + x), q = b.at<unsigned char>(cy + y, cx + x);
      weights += w;
      ma += w * p;
      mb += w * q;
      aa += w * p * p;
      bb += w * q * q;
      ab += w * p * q;
    }
  ma /= weights;
  mb /= weights;
  const double va = aa / weights - ma * ma, vb = bb / weights - mb * mb, cov = ab / weights - ma * mb;
  return (2 * ma * mb + 6.5025) * (2 * cov + 58.5225) / ((ma * ma + mb * mb + 6.5025) * (va + vb + 58.5225));
}

TEST(ImageMetrics, SsimByDefinition) {
  cv::Mat a(40, 50, CV_8UC1), b(40, 50, CV_8UC1);
  cv::RNG generator(4);
  generator.fill(a, cv::RNG::UNIFORM, 0, 256);
  generator.fill(b, cv::RNG::UNIFORM, 0, 256);
  b = a * 0.7 + b * 0.3;
  const cv::Mat map = ssim_map(a, b);
  ASSERT_EQ(map.size(), cv::Size(40, 30));
  for (const auto& [x, y] : {std::pair(5, 5), std::pair(20, 17), std::pair(44, 34)})
    EXPECT_NEAR(map.at<double>(y - 5, x - 5), ssim_at(a, b, x, y), 1e-9);
  EXPECT_NEAR(masked_ssim(a, a, cv::Mat(40, 50, CV_8UC1, cv::Scalar(1))), 1, 1e-12);
  EXPECT_TRUE(std::isnan(masked_ssim(a, b, cv::Mat(40, 50, CV_8UC1, cv::Scalar(0)))));
  cv::Mat one(40, 50, CV_8UC1, cv::Scalar(0));
  one.at<unsigned char>(17, 20) = 1;
  EXPECT_NEAR(masked_ssim(a, b, one), ssim_at(a, b, 20, 17), 1e-9);
}

TEST(ImageMetrics, Ciede2000OnSharmasPairs) {
  const double pairs[34][7] = {{50, 2.6772, -79.7751, 50, 0, -82.7485, 2.0425},
                               {50, 3.1571, -77.2803, 50, 0, -82.7485, 2.8615},
                               {50, 2.8361, -74.0200, 50, 0, -82.7485, 3.4412},
                               {50, -1.3802, -84.2814, 50, 0, -82.7485, 1.0000},
                               {50, -1.1848, -84.8006, 50, 0, -82.7485, 1.0000},
                               {50, -0.9009, -85.5211, 50, 0, -82.7485, 1.0000},
                               {50, 0, 0, 50, -1, 2, 2.3669},
                               {50, -1, 2, 50, 0, 0, 2.3669},
                               {50, 2.4900, -0.0010, 50, -2.4900, 0.0009, 7.1792},
                               {50, 2.4900, -0.0010, 50, -2.4900, 0.0010, 7.1792},
                               {50, 2.4900, -0.0010, 50, -2.4900, 0.0011, 7.2195},
                               {50, 2.4900, -0.0010, 50, -2.4900, 0.0012, 7.2195},
                               {50, -0.0010, 2.4900, 50, 0.0009, -2.4900, 4.8045},
                               {50, -0.0010, 2.4900, 50, 0.0010, -2.4900, 4.8045},
                               {50, -0.0010, 2.4900, 50, 0.0011, -2.4900, 4.7461},
                               {50, 2.5, 0, 50, 0, -2.5, 4.3065},
                               {50, 2.5, 0, 73, 25, -18, 27.1492},
                               {50, 2.5, 0, 61, -5, 29, 22.8977},
                               {50, 2.5, 0, 56, -27, -3, 31.9030},
                               {50, 2.5, 0, 58, 24, 15, 19.4535},
                               {50, 2.5, 0, 50, 3.1736, 0.5854, 1.0000},
                               {50, 2.5, 0, 50, 3.2972, 0, 1.0000},
                               {50, 2.5, 0, 50, 1.8634, 0.5757, 1.0000},
                               {50, 2.5, 0, 50, 3.2592, 0.3350, 1.0000},
                               {60.2574, -34.0099, 36.2677, 60.4626, -34.1751, 39.4387, 1.2644},
                               {63.0109, -31.0961, -5.8663, 62.8187, -29.7946, -4.0864, 1.2630},
                               {61.2901, 3.7196, -5.3901, 61.4292, 2.2480, -4.9620, 1.8731},
                               {35.0831, -44.1164, 3.7933, 35.0232, -40.0716, 1.5901, 1.8645},
                               {22.7233, 20.0904, -46.6940, 23.0331, 14.9730, -42.5619, 2.0373},
                               {36.4612, 47.8580, 18.3852, 36.2715, 50.5065, 21.2231, 1.4146},
                               {90.8027, -2.0831, 1.4410, 91.1528, -1.6435, 0.0447, 1.4441},
                               {90.9257, -0.5406, -0.9208, 88.6381, -0.8985, -0.7239, 1.5381},
                               {6.7747, -0.2908, -2.4247, 5.8714, -0.0985, -2.2286, 0.6377},
                               {2.0776, 0.0795, -1.1350, 0.9033, -0.0636, -0.5514, 0.9082}};
  for (const auto& p : pairs) {
    EXPECT_NEAR(ciede2000({p[0], p[1], p[2]}, {p[3], p[4], p[5]}), p[6], 5e-5) << p[1] << " " << p[2];
    EXPECT_NEAR(ciede2000({p[3], p[4], p[5]}, {p[0], p[1], p[2]}), p[6], 5e-5);
  }
}

TEST(ImageMetrics, LabOfKnownColours) {
  const auto white = lab_of_srgb(255, 255, 255), red = lab_of_srgb(255, 0, 0);
  EXPECT_NEAR(white[0], 100, 1e-3);
  EXPECT_NEAR(white[1], 0, 0.02);
  EXPECT_NEAR(red[0], 53.24, 0.01);
  EXPECT_NEAR(red[1], 80.09, 0.01);
  EXPECT_NEAR(red[2], 67.20, 0.01);
}

TEST(ImageMetrics, GainIsFoundAndTakenOut) {
  cv::Mat truth(30, 30, CV_8UC3);
  cv::RNG generator(9);
  generator.fill(truth, cv::RNG::UNIFORM, 20, 120);
  const cv::Mat brighter = with_gain(truth, {1.5, 1.2, 0.8}), mask(30, 30, CV_8UC1, cv::Scalar(255));
  const cv::Vec3d gain = gain_to_match({brighter}, {truth}, {mask});
  EXPECT_NEAR(gain[0], 1 / 1.5, 0.01);
  EXPECT_NEAR(gain[1], 1 / 1.2, 0.01);
  EXPECT_NEAR(gain[2], 1 / 0.8, 0.01);
  EXPECT_LE(cv::norm(with_gain(brighter, gain), truth, cv::NORM_INF), 2);
  EXPECT_EQ(gain_to_match({brighter}, {truth}, {mask * 0}), cv::Vec3d(1, 1, 1));
}

}  // namespace
}  // namespace dressform::metrics
