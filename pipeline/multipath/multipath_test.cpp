#include "pipeline/multipath/multipath.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "pipeline/multipath/apply.h"
#include "pipeline/multipath/bounce_kernel.h"
#include "pipeline/multipath/bounce_pixels.h"
#include "pipeline/multipath/floor_evidence.h"
#include "pipeline/testing/multipath_images.h"
#include "pipeline/testing/test_scene.h"
#include "scenes/devices/device.h"

namespace dressform {
namespace {

using namespace multipath_test;
using namespace test_scene;

// Two walls at a right angle, their edge upright at 2.5 m.
double corner_depth(double x) { return 2.5 / (1 + std::abs(x)); }

TEST(Multipath, OneSourceAndOneReceiverAreThePhasorsOfTheBooks) {
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

TEST(Multipath, APlaneDoesNotLightItselfEvenWithNoise) {
  const DepthOptics optics(plain_kinect());
  const cv::Mat plane = image_of(optics, [&](double x, double y, int u, int v) {
    return 2 / (1 + 0.3 * x + 0.2 * y) + 0.003 * normal4(1, 1, static_cast<std::uint64_t>(v) * 512 + u)[0];
  });
  for (const float error : errors_of(surface_cells(plane, {}, optics))) EXPECT_LT(std::abs(error), 2e-4);
}

TEST(Multipath, CellsCoverImagesOfAnySize) {
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

TEST(Multipath, ACornerOfTwoWallsIsThatOfAFineSum) {
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

TEST(Multipath, AlbedoComesBackFromTheAmplitude) {
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

Isometry3d stand(int k) {
  const double angle = M_PI / 2 * k + 0.1;
  return looking_at({2.1 * std::sin(angle), 1.25, 2.1 * std::cos(angle)}, {0, 1.1, 0});
}

// The figure in its room with `strength` times the predicted errors on top.
cv::Mat bent_image(const DepthOptics& optics, const Isometry3d& pose, double strength, double noise, Seed seed) {
  const cv::Mat exact = depth_image(standing_figure(), optics.calibration, optics.rays, pose, noise, seed);
  const SurfaceCells cells = surface_cells(exact, {}, optics);
  return without_bounce(exact, cells, light_of(cells), {}, optics, -strength);
}

TEST(Multipath, TheFloorTellsHowMuchThereIs) {
  const DepthOptics optics(kinect(0.6));
  for (const double strength : {0.0, 0.6, 1.0}) {
    const SurfaceCells cells = surface_cells(bent_image(optics, stand(0), strength, 1, 5), {}, optics);
    const FloorEvidence floor = floor_evidence(cells, errors_of(cells));
    ASSERT_TRUE(floor.found);
    EXPECT_NEAR(floor.factor, strength, 0.2) << strength;
  }
}

TEST(Multipath, WithoutAFloorNothingIsSaid) {
  const DepthOptics optics(plain_kinect());
  const cv::Mat wall = image_of(optics, [](double, double, int, int) { return 2.0; });
  const SurfaceCells cells = surface_cells(wall, {}, optics);
  EXPECT_FALSE(floor_evidence(cells, errors_of(cells)).found);
}

struct Captured {
  CaptureSession session;
  Calibration calibration;
};

cv::Mat infrared(const cv::Mat& depth_mm, const DepthOptics& optics) {
  cv::Mat ir(depth_mm.size(), CV_16U, cv::Scalar(0));
  const SurfaceCells cells = surface_cells(depth_mm, {}, optics);
  for (int y = 0; y < ir.rows; ++y)
    for (int x = 0; x < ir.cols; ++x) {
      const int column = std::min(x / cells.edge_px, cells.columns - 1),
                row = std::min(y / cells.edge_px, cells.rows - 1);
      const int i = row * cells.columns + column;
      if (cells.z[i] == 0) continue;
      const Vector3d point(cells.x[i], cells.y[i], cells.z[i]), light = point - Vector3d(0.045, 0, 0);
      const Vector3d normal(cells.normal_x[i], cells.normal_y[i], cells.normal_z[i]);
      const double stretch = point.norm() / point.z(), lit = std::max(0.1, -normal.dot(light) / light.norm());
      ir.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(
          std::min(65535.0, 16 * kSignal * kAlbedo * lit * std::pow(stretch, -3) / light.squaredNorm()));
    }
  return ir;
}

Captured capture(double strength, const std::string& model = "kinect_v2") {
  Captured result;
  SensorCalibration sensor = kinect(0.5);
  sensor.model = model;
  const DepthOptics optics(sensor);
  for (int k = 0; k < 4; ++k) {
    const std::string name = "k" + std::to_string(k + 1);
    result.session.sensors.push_back(name);
    result.calibration.sensors[name] = sensor;
    for (auto* shots : {&result.session.naked, &result.session.dressed}) {
      Shot& shot = (*shots)[name];
      shot.depth_mm = bent_image(optics, stand(k), strength, 0.5, 10 + k);
      shot.ir = infrared(shot.depth_mm, optics);
    }
  }
  result.calibration.sensors["handheld"] = sensor;
  DepthScan& scan = result.session.scans["scan_naked"];
  scan.sensor = "handheld";
  for (int k = 0; k < 6; ++k) scan.depth_mm.push_back(bent_image(optics, stand(k), strength, 0.5, 20 + k));
  return result;
}

Multipath estimate(const Captured& captured, const std::string& variant = "one_bounce") {
  return EstimateMultipath::at(variant).run(captured.session, captured.calibration, {{"factor", 1.0}}, 1);
}

double rms_difference(const cv::Mat& a, const cv::Mat& b) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < a.rows; ++y)
    for (int x = 0; x < a.cols; ++x) {
      const double d = a.at<std::uint16_t>(y, x) - static_cast<double>(b.at<std::uint16_t>(y, x));
      if (a.at<std::uint16_t>(y, x) == 0 || b.at<std::uint16_t>(y, x) == 0) continue;
      sum += d * d;
      ++count;
    }
  return std::sqrt(sum / std::max(1, count));
}

TEST(Multipath, BouncedLightIsFoundAndTakenOff) {
  const Captured bent = capture(1), straight = capture(0);
  const Multipath found = estimate(bent);
  EXPECT_EQ(found.shots.factor, 1);
  EXPECT_NEAR(found.shots.measured, 1, 0.25);
  EXPECT_EQ(found.scans.at("scan_naked").factor, 1);
  EXPECT_NEAR(found.floor_albedo, kAlbedo, 0.08);
  const CaptureSession clean = without_multipath(bent.session, bent.calibration, found);
  const DepthScan scan = without_multipath(bent.session.scans.at("scan_naked"), bent.calibration.sensors.at("handheld"),
                                           found, found.scans.at("scan_naked"));
  for (const auto& sensor : bent.session.sensors) {
    const cv::Mat& truth = straight.session.dressed.at(sensor).depth_mm;
    const double before = rms_difference(bent.session.dressed.at(sensor).depth_mm, truth);
    EXPECT_GT(before, 3);
    EXPECT_LT(rms_difference(clean.dressed.at(sensor).depth_mm, truth), 0.35 * before) << sensor;
    EXPECT_LT(rms_difference(clean.naked.at(sensor).depth_mm, straight.session.naked.at(sensor).depth_mm),
              0.35 * before);
  }
  for (std::size_t i = 0; i < scan.depth_mm.size(); ++i) {
    const cv::Mat& truth = straight.session.scans.at("scan_naked").depth_mm[i];
    EXPECT_LT(rms_difference(scan.depth_mm[i], truth),
              0.35 * rms_difference(bent.session.scans.at("scan_naked").depth_mm[i], truth));
  }
}

TEST(Multipath, InfraredOfAnotherScaleIsNotUsed) {
  for (const double scale : {0.0, 1e-3, 30.0}) {  // none, 8 bits in 16, stretched to the brightest
    Captured bent = capture(1);
    for (auto* shots : {&bent.session.naked, &bent.session.dressed})
      for (auto& [name, shot] : *shots) {
        if (scale == 0)
          shot.ir = cv::Mat();
        else
          shot.ir.convertTo(shot.ir, CV_16U, scale);
      }
    const Multipath found = estimate(bent);
    EXPECT_EQ(found.infrared_scaled, scale == 0) << scale;
    EXPECT_EQ(found.shots.images, 8) << scale;
    EXPECT_GT(found.shots.measured, 0.3) << scale;
    EXPECT_LT(found.shots.measured, 3) << scale;
    const CaptureSession clean = without_multipath(bent.session, bent.calibration, found);
    const cv::Mat truth = capture(0).session.dressed.at("k1").depth_mm;
    EXPECT_LT(rms_difference(clean.dressed.at("k1").depth_mm, truth),
              0.8 * rms_difference(bent.session.dressed.at("k1").depth_mm, truth))
        << scale;
  }
}

// Floors that bend eighteen times as much as light can bend them bend for another reason.
TEST(Multipath, MoreThanThereCanBeIsNotTakenOff) {
  const Multipath found = estimate(capture(5));
  EXPECT_GT(found.shots.measured, 3);
  EXPECT_EQ(found.shots.factor, 0);
}

TEST(Multipath, StraightDepthIsLeftAlone) {
  const Multipath found = estimate(capture(0));
  EXPECT_EQ(found.shots.factor, 0);
  EXPECT_EQ(found.shots.images, 8);
  EXPECT_NEAR(found.shots.measured, 0, 0.2);
  EXPECT_EQ(found.scans.at("scan_naked").factor, 0);
}

TEST(Multipath, OtherKindsOfSensorsAreNotLookedAt) {
  for (const char* model : {"kinect_v1", ""}) {
    const Multipath found = estimate(capture(1, model));
    EXPECT_EQ(found.shots.factor, 0) << model;
    EXPECT_EQ(found.shots.images, 0) << model;
    EXPECT_TRUE(found.scans.empty()) << model;
  }
}

// Devices say for themselves how they measure: nobody here knows their names.
TEST(Multipath, EveryDeviceThatMeasuresTimeOfFlightIsLookedAt) {
  SensorDevice device;
  device.name = "multipath_test_tof";
  device.time_of_flight = true;
  static const DeviceDeclaration declaration{device};
  const Multipath found = estimate(capture(1, device.name));
  EXPECT_EQ(found.shots.factor, 1);
  EXPECT_EQ(found.shots.images, 8);
}

bool same_bytes(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && (a.empty() || cv::norm(a, b, cv::NORM_INF) == 0);
}

void expect_same_shots(const CaptureSession& a, const CaptureSession& b) {
  for (const auto& [shots, others] : {std::pair{&a.naked, &b.naked}, {&a.dressed, &b.dressed}})
    for (const auto& [name, shot] : *shots) {
      EXPECT_TRUE(same_bytes(shot.depth_mm, others->at(name).depth_mm)) << name;
      EXPECT_TRUE(same_bytes(shot.ir, others->at(name).ir)) << name;
    }
}

TEST(Multipath, SessionsOfOtherSensorsKeepTheirBytes) {
  for (const char* model : {"kinect_v1", "", "primesense"}) {
    const Captured captured = capture(1, model);
    Multipath certain = estimate(captured);
    EXPECT_TRUE(certain.scans.empty()) << model;
    certain.shots.factor = 1;  // as if another sensor of the rig had shown bounced light
    expect_same_shots(captured.session, without_multipath(captured.session, captured.calibration, certain));
  }
}

TEST(Multipath, ImagesThatShowNoneKeepTheirBytes) {
  const Captured captured = capture(0);
  const Multipath found = estimate(captured);
  expect_same_shots(captured.session, without_multipath(captured.session, captured.calibration, found));
  const DepthScan& scan = captured.session.scans.at("scan_naked");
  const DepthScan same =
      without_multipath(scan, captured.calibration.sensors.at("handheld"), found, found.scans.at("scan_naked"));
  for (std::size_t i = 0; i < scan.depth_mm.size(); ++i) EXPECT_TRUE(same_bytes(scan.depth_mm[i], same.depth_mm[i]));
}

TEST(Multipath, TheVariantNoneTakesDepthAsItIs) {
  const Captured bent = capture(1);
  const Multipath found = EstimateMultipath::at("none").run(bent.session, bent.calibration, {}, 1);
  EXPECT_EQ(found.shots.factor, 0);
  EXPECT_TRUE(found.scans.empty());
}

TEST(Multipath, EmptySmallAndBlindImages) {
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
  Captured captured = capture(1);
  for (auto& [name, shot] : captured.session.naked) shot.depth_mm.setTo(0);
  for (auto& [name, shot] : captured.session.dressed) shot.ir.release(), shot.depth_mm.setTo(0);
  captured.session.scans["scan_naked"].depth_mm.clear();
  const Multipath found = estimate(captured);
  EXPECT_EQ(found.shots.factor, 0);
  EXPECT_EQ(found.scans.at("scan_naked").factor, 0);
}

}  // namespace
}  // namespace dressform
