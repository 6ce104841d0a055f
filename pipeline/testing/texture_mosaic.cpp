#include "pipeline/testing/texture_mosaic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "scenes/random.h"

namespace dressform::testing_images {
namespace {

struct Texture {
  int kind;  // stripes, checks, dots, speckle, plain
  cv::Vec3f light, dark;
  double period_px, angle;

  // How much of the second colour there is at (x, y).
  bool dark_at(double x, double y, double random) const {
    const double u = (x * std::cos(angle) + y * std::sin(angle)) / period_px;
    const double v = (y * std::cos(angle) - x * std::sin(angle)) / period_px;
    const double du = u - std::floor(u), dv = v - std::floor(v);
    switch (kind) {
      case 0:
        return du < 0.5;
      case 1:
        return (du < 0.5) != (dv < 0.5);
      case 2:
        return std::hypot(du - 0.5, dv - 0.5) < 0.33;
      case 3:
        return random < 0.4;
      default:
        return false;
    }
  }
};

double distance(const cv::Vec3f& a, const cv::Vec3f& b) { return cv::norm(a - b); }

// Colours that no other texture has, the two of a texture apart.
std::vector<Texture> some_textures(Seed seed, int count) {
  constexpr double kApart = 70;  // 8-bit units
  std::vector<Texture> textures;
  for (std::uint64_t draw = 0; static_cast<int>(textures.size()) < count; ++draw) {
    const auto a = uniform4(seed, stream_of("light"), draw), b = uniform4(seed, stream_of("dark"), draw);
    Texture next{
        static_cast<int>(textures.size() + seed) % 5,
        cv::Vec3f(static_cast<float>(255 * a[0]), static_cast<float>(255 * a[1]), static_cast<float>(255 * a[2])),
        cv::Vec3f(static_cast<float>(255 * b[0]), static_cast<float>(255 * b[1]), static_cast<float>(255 * b[2])),
        6 + 6 * a[3], M_PI * b[3]};
    bool apart = distance(next.light, next.dark) > kApart;
    for (const Texture& other : textures) apart = apart && distance(next.light, other.light) > kApart;
    if (apart) textures.push_back(next);
  }
  return textures;
}

std::vector<cv::Point2d> scattered(Seed seed, int count, const cv::Size& size) {
  const double least = 0.7 * std::sqrt(size.area() / static_cast<double>(count));
  std::vector<cv::Point2d> points;
  for (std::uint64_t draw = 0; static_cast<int>(points.size()) < count; ++draw) {
    const auto u = uniform4(seed, stream_of("sites"), draw);
    const cv::Point2d next(size.width * u[0], size.height * u[1]);
    bool apart = true;
    // Closer and closer, should there be no room.
    for (const auto& other : points)
      apart = apart && cv::norm(next - other) > least * std::pow(0.99, static_cast<double>(draw));
    if (apart) points.push_back(next);
  }
  return points;
}

cv::Mat borders(const cv::Mat& regions) {
  cv::Mat result = cv::Mat::zeros(regions.size(), CV_8U);
  for (int y = 0; y < regions.rows; ++y) {
    for (int x = 0; x < regions.cols; ++x) {
      const int here = regions.at<int>(y, x);
      const bool right = x + 1 < regions.cols && regions.at<int>(y, x + 1) != here;
      const bool below = y + 1 < regions.rows && regions.at<int>(y + 1, x) != here;
      if (right || below) result.at<uchar>(y, x) = 255;
    }
  }
  return result;
}

// Of the pixels of `of`, those near one of `to`.
double near_part(const cv::Mat& of, const cv::Mat& to, double tolerance_px) {
  const int all = cv::countNonZero(of);
  if (all == 0) return cv::countNonZero(to) == 0;
  if (cv::countNonZero(to) == 0) return 0;
  cv::Mat away;
  cv::distanceTransform(to == 0, away, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return cv::countNonZero(of & (away <= tolerance_px)) / static_cast<double>(all);
}

}  // namespace

TextureMosaic texture_mosaic(Seed seed, int count, const cv::Size& size) {
  const auto textures = some_textures(seed, count);
  const auto sites = scattered(seed, count, size);
  TextureMosaic mosaic{cv::Mat(size, CV_8UC3), cv::Mat(size, CV_32S)};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const cv::Point2d bent(x + 9 * std::sin(y / 23.0), y + 9 * std::sin(x / 29.0));
      int nearest = 0;
      for (int k = 1; k < count; ++k)
        if (cv::norm(bent - sites[k]) < cv::norm(bent - sites[nearest])) nearest = k;
      mosaic.regions.at<int>(y, x) = nearest + 1;
      const std::uint64_t index = static_cast<std::uint64_t>(y) * size.width + x;
      const bool dark = textures[nearest].dark_at(x, y, uniform(seed, stream_of("speckle"), index));
      const auto noise = normal4(seed, stream_of("camera"), index);
      for (int c = 0; c < 3; ++c)
        mosaic.bgr.at<cv::Vec3b>(y, x)[c] =
            cv::saturate_cast<uchar>((dark ? textures[nearest].dark : textures[nearest].light)[c] + 2 * noise[c]);
    }
  }
  return mosaic;
}

double boundary_f(const cv::Mat& found, const cv::Mat& truth, double tolerance_px) {
  const cv::Mat a = borders(found), b = borders(truth);
  const double precision = near_part(a, b, tolerance_px), recall = near_part(b, a, tolerance_px);
  return precision + recall > 0 ? 2 * precision * recall / (precision + recall) : 0;
}

TEST(TextureMosaic, BordersThatAreMovedAreFoundWithinTheTolerance) {
  cv::Mat a(40, 40, CV_32S, cv::Scalar(1)), b = a.clone();
  a.colRange(20, 40).setTo(2);
  b.colRange(23, 40).setTo(2);
  EXPECT_EQ(boundary_f(a, a, 0), 1);
  EXPECT_EQ(boundary_f(a, b, 3), 1);
  EXPECT_EQ(boundary_f(a, b, 2), 0);
  EXPECT_EQ(boundary_f(cv::Mat(40, 40, CV_32S, cv::Scalar(1)), a, 3), 0);
}

}  // namespace dressform::testing_images
