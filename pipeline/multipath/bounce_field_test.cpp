#include "pipeline/multipath/bounce_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "pipeline/multipath/bounce_kernel.h"
#include "pipeline/multipath/bounce_pixels.h"
#include "pipeline/multipath/floor_evidence.h"
#include "pipeline/testing/multipath_images.h"
#include "pipeline/testing/test_scene.h"

namespace dressform {
namespace {

using namespace multipath_test;
using namespace test_scene;

// Two walls at a right angle, their edge upright at 2.5 m.
double corner_depth(double x) { return 2.5 / (1 + std::abs(x)); }

TEST(BouncedLight, OneSourceAndOneReceiverAreThePhasorsOfTheBooks) {
  const bounce::Source source{0.3f, 0.9f, 2.2f, 0, -1, 0, 2.4f, 0.01f, 0.0025f};
  const float x = 0, y = 0.2f, z = 2, nx = 0, ny = 0.6f, nz = -0.8f, way = 2.01f;
  float cosine[3] = {}, sine[3] = {};
  bounce::add_source(source, {&x, &y, &z, &nx, &ny, &nz, &way, 1}, {&cosine[0], &cosine[1], &cosine[2]},
                     {&sine[0], &sine[1], &sine[2]});
  const Vector3d step(0.3, 0.7, 0.2);
  const double arrives = Vector3d(0, 0.6, -0.8).dot(step), leaves = Vector3d(0, -1, 0).dot(-step);
  const double light = 0.01 * arrives * leaves / (step.squaredNorm() * (step.squaredNorm() + 0.0025 / M_PI));
  const double detour = 2.4 + step.norm() - 2.01, megahertz[3] = {80, 16, 120};
  for (int f = 0; f < 3; ++f) {
    const double phase = 2 * M_PI * megahertz[f] * 1e6 * detour / 299792458.0;
    EXPECT_NEAR(cosine[f], light * std::cos(phase), 1e-6 * light + 1e-9);
    EXPECT_NEAR(sine[f], light * std::sin(phase), 1e-5 * light + 1e-9);
  }
}

TEST(BouncedLight, APlaneDoesNotLightItselfEvenWithNoise) {
  const DepthOptics optics(plain_kinect());
  const cv::Mat plane = image_of(optics, [&](double x, double y, int u, int v) {
    return 2 / (1 + 0.3 * x + 0.2 * y) + 0.003 * normal4(1, 1, static_cast<std::uint64_t>(v) * 512 + u)[0];
  });
  for (const float error : errors_of(surface_cells(plane, {}, optics))) EXPECT_LT(std::abs(error), 2e-4);
}

TEST(BouncedLight, CellsCoverImagesOfAnySize) {
  // The lowest rows hold the floor that sends most.
  for (const double scale : {1.0, 0.6, 0.37, 0.25}) {
    SensorCalibration sensor = test_scene::kinect(scale);
    sensor.ir.distortion = {};
    const DepthOptics optics(sensor);
    const cv::Mat wall = image_of(optics, [](double, double, int, int) { return 2.0; });
    double whole = 0, seen = 0;
    for (int v = 0; v < wall.rows; ++v)
      for (int u = 0; u < wall.cols; ++u) {
        const auto& ray = optics.rays.at<cv::Vec2d>(v, u);
        whole += std::pow(1 + ray.dot(ray), -1.5) / (sensor.ir.fx * sensor.ir.fy);
      }
    for (const float angle : surface_cells(wall, {}, optics).solid_angle) seen += angle;
    EXPECT_NEAR(seen, whole, 0.002 * whole) << "scale " << scale;
  }
}

// Light from the other wall, summed up finely; as the driver decodes it. Millimetres along the axis.
double error_in_the_corner(const Vector3d& at, const Vector3d& normal) {
  const Vector3d emitter(0.045, 0, 0);
  const double direct_way = (at - emitter).norm(), stretch = at.norm() / at.z();
  const double direct = stretch * -normal.dot(at - emitter) / std::pow(direct_way, 3);
  double cosine[3] = {}, sine[3] = {};
  constexpr int kSteps = 900;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {  // the other wall, over the image's rays
      const double x = 0.7 * (i + 0.5) / kSteps, y = -0.57 + 1.14 * (j + 0.5) / kSteps, z = corner_depth(x);
      const Vector3d from(x * z, y * z, z), back = Vector3d(-1, 0, -1).normalized(), step = from - at;
      const double s = from.norm() / z, angle = 0.7 / kSteps * 1.14 / kSteps / (s * s * s);
      const double light = kAlbedo / M_PI * s * angle * std::max(0.0, normal.dot(step)) *
                           std::max(0.0, -back.dot(step)) / std::pow(step.squaredNorm(), 2);
      const double detour = (from - emitter).norm() + step.norm() - direct_way;
      const double megahertz[3] = {80, 16, 120};
      for (int f = 0; f < 3; ++f) {
        const double phase = 2 * M_PI * megahertz[f] * detour / 299.792458;
        cosine[f] += light * std::cos(phase), sine[f] += light * std::sin(phase);
      }
    }
  double turns = 0;
  for (int f = 0; f < 3; ++f) turns += std::atan2(sine[f], direct + cosine[f]) / (2 * M_PI);
  return 1e3 * 2.0833333 / 3 * turns / stretch;
}

TEST(BouncedLight, ACornerOfTwoWallsIsThatOfAFineSum) {
  const DepthOptics optics(plain_kinect());
  const SurfaceCells cells =
      surface_cells(image_of(optics, [](double x, double, int, int) { return corner_depth(x); }), {}, optics);
  const auto errors = errors_of(cells);
  for (const int column : {16, 22, 26}) {  // the wall on the left
    const int i = 26 * cells.columns + column;
    const Vector3d at(cells.x[i], cells.y[i], cells.z[i]);
    const double expected = error_in_the_corner(at, Vector3d(1, 0, -1).normalized());
    EXPECT_GT(expected, 3) << column;
    EXPECT_NEAR(1e3 * errors[i], expected, 0.1 * expected) << column;
  }
}

TEST(BouncedLight, AlbedoComesBackFromTheAmplitude) {
  const DepthOptics optics(plain_kinect());
  const auto depth = [](double x, double y, int, int) { return 2 / (1 + 0.4 * x - 0.2 * y); };
  const cv::Mat image = image_of(optics, depth);
  cv::Mat ir(image.size(), CV_16U);
  const Vector3d normal = -Vector3d(0.4, -0.2, 1).normalized(), emitter(0.045, 0, 0);
  for (int y = 0; y < ir.rows; ++y)
    for (int x = 0; x < ir.cols; ++x) {
      const auto& ray = optics.rays.at<cv::Vec2d>(y, x);
      const Vector3d point = Vector3d(ray[0], ray[1], 1) * depth(ray[0], ray[1], x, y), light = point - emitter;
      const double stretch = point.norm() / point.z();
      ir.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(
          std::lround(16 * kSignal * 0.37 * std::pow(stretch, -3) * -normal.dot(light) / std::pow(light.norm(), 3)));
    }
  const SurfaceCells cells = surface_cells(image, ir, optics);
  const auto albedo = albedo_of(cells, kSignal);
  for (int i = 0; i < cells.count(); ++i) EXPECT_NEAR(albedo[i], 0.37, 0.01) << i;
}

TEST(BouncedLight, TheFloorTellsHowMuchThereIs) {
  const DepthOptics optics(kinect(0.6));
  for (const double strength : {0.0, 0.6, 1.0}) {
    const SurfaceCells cells = surface_cells(bent_image(optics, stand(0), strength, 1, 5), {}, optics);
    const FloorEvidence floor = floor_evidence(cells, errors_of(cells));
    ASSERT_TRUE(floor.found);
    EXPECT_NEAR(floor.factor, strength, 0.2) << strength;
  }
}

TEST(BouncedLight, WithoutAFloorNothingIsSaid) {
  const DepthOptics optics(plain_kinect());
  const cv::Mat wall = image_of(optics, [](double, double, int, int) { return 2.0; });
  const SurfaceCells cells = surface_cells(wall, {}, optics);
  EXPECT_FALSE(floor_evidence(cells, errors_of(cells)).found);
}

TEST(BouncedLight, EmptyAndSmallImagesGiveFiniteErrors) {
  SensorCalibration sensor = kinect(1);
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 5}, {64, 3}, {512, 424}}) {
    sensor.ir.width = width, sensor.ir.height = height;
    const DepthOptics optics(sensor);
    for (const int value : {0, 1, 2000, 65535}) {
      const cv::Mat image(height, width, CV_16U, cv::Scalar(value));
      const SurfaceCells cells = surface_cells(image, image, optics);
      const BouncedLight light = bounced_light(cells, albedo_of(cells, kSignal));
      const auto errors = bounce_errors_m(cells, light);
      for (const float error : errors) ASSERT_TRUE(std::isfinite(error));
      for (const cv::Mat& ir : {image, cv::Mat()})
        EXPECT_EQ(without_bounce(image, cells, light, {ir, kSignal}, optics, 1).size(), image.size());
      EXPECT_TRUE(std::isfinite(floor_evidence(cells, errors).factor));
    }
  }
}

}  // namespace
}  // namespace dressform
