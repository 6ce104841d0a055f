#include "pipeline/multipath/bounce_pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "pipeline/testing/multipath_images.h"

namespace dressform {
namespace {

using namespace multipath_test;

// The same light, 30 degrees late at every frequency, everywhere.
BouncedLight even_light(const SurfaceCells& cells, double strength) {
  BouncedLight light{cells.count(), std::vector<float>(BouncedLight::terms * static_cast<std::size_t>(cells.count()))};
  for (int t = 0; t < BouncedLight::terms; ++t)
    std::fill_n(light.sums.begin() + static_cast<std::ptrdiff_t>(t) * cells.count(), cells.count(),
                static_cast<float>(strength * (t % 2 ? 0.5 : std::sqrt(0.75))));
  return light;
}

// An upright limb, 2 m away, and what comes back from it.
struct Limb {
  static constexpr double radius = 0.08, distance = 2;
  cv::Mat depth, ir;
  static constexpr int row = 212;
  std::vector<double> cosine;  // to the emitter, in that row
  Limb(const DepthOptics& optics, const BouncedLight& light)
      : depth(424, 512, CV_16U, cv::Scalar(0)), ir(424, 512, CV_16U, cv::Scalar(0)), cosine(512, 0) {
    for (int u = 0; u < depth.cols; ++u)
      for (int v = 0; v < depth.rows; ++v) {
        const auto& ray = optics.rays.at<cv::Vec2d>(v, u);
        // |ray x z - centre| = radius in the plane of x and z
        const double a = 1 + ray[0] * ray[0], half = distance,
                     under = half * half - a * (half * half - radius * radius);
        if (under <= 0) continue;
        const double z = (half - std::sqrt(under)) / a, x = ray[0] * z, y = ray[1] * z;
        const Eigen::Vector3d normal = Eigen::Vector3d(x, 0, z - distance) / radius;
        const double lit = lit_cosine(x, y, z, normal);
        if (v == row) cosine[u] = lit;
        if (lit < 0.12) continue;
        depth.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(std::lround(1000 * z));
        const double bounced = (light.term(0)[0] + light.term(2)[0] + light.term(4)[0]) / 3;
        ir.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(
            std::lround(16 * kAlbedo * (direct_light(x, y, z, lit) + bounced) / light_per_count(x, y, z, kSignal)));
      }
  }
};

TEST(BouncePixels, SidesOfALimbAreBentAsTheirOwnLightFades) {
  const DepthOptics optics(plain_kinect());
  const double front = direct_light(0, 0, 2 - Limb::radius, 1);
  const BouncedLight light =
      even_light(surface_cells(cv::Mat(424, 512, CV_16U, cv::Scalar(0)), {}, optics), 0.03 * front);
  const Limb limb(optics, light);
  const SurfaceCells cells = surface_cells(limb.depth, limb.ir, optics);
  const cv::Mat seen = without_bounce(limb.depth, cells, light, {limb.ir, kSignal}, optics, 10);
  const cv::Mat blind = without_bounce(limb.depth, cells, light, {}, optics, 10);
  const int v = Limb::row;
  double least = 1;
  for (int u = 0; u < 512; ++u) {
    if (limb.depth.at<std::uint16_t>(v, u) == 0) continue;
    float bounced[BouncedLight::terms];
    for (int t = 0; t < BouncedLight::terms; ++t) bounced[t] = light.term(t)[0];
    const auto& ray = optics.rays.at<cv::Vec2d>(v, u);
    const double z = 1e-3 * limb.depth.at<std::uint16_t>(v, u);
    const double expected = 1e4 * bounce_error_m(direct_light(ray[0] * z, ray[1] * z, z, limb.cosine[u]), bounced,
                                                 std::hypot(ray[0], ray[1], 1));
    const auto taken = [&](const cv::Mat& image) { return 1e3 * z - image.at<std::uint16_t>(v, u); };
    EXPECT_NEAR(taken(seen), expected, 0.12 * expected + 1) << u << " " << limb.cosine[u];
    EXPECT_NEAR(taken(blind), expected, (limb.cosine[u] > 0.5 ? 0.15 : 0.4) * expected + 1)
        << u << " " << limb.cosine[u];
    least = std::min(least, limb.cosine[u]);
  }
  EXPECT_LT(least, 0.4);
}

TEST(BouncePixels, ADarkPrintIsNotTakenForASlope) {
  const DepthOptics optics(plain_kinect());
  const cv::Mat wall = image_of(optics, [](double, double, int, int) { return 2.0; });
  cv::Mat ir(wall.size(), CV_16U, cv::Scalar(2400)), printed = ir.clone();
  printed(cv::Rect(250, 200, 4, 12)).setTo(800);
  const SurfaceCells cells = surface_cells(wall, ir, optics), dark = surface_cells(wall, printed, optics);
  const BouncedLight light = even_light(cells, 0.03 * direct_light(0, 0, 2, 1));
  const cv::Mat plain = without_bounce(wall, cells, light, {ir, kSignal}, optics, 10);
  const cv::Mat result = without_bounce(wall, dark, light, {printed, kSignal}, optics, 10);
  EXPECT_GT(2000 - plain.at<std::uint16_t>(206, 252), 40);
  EXPECT_NEAR(result.at<std::uint16_t>(206, 252), plain.at<std::uint16_t>(206, 252), 3);
}

}  // namespace
}  // namespace dressform
