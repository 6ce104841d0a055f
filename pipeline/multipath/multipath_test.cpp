#include "pipeline/multipath/multipath.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <utility>

#include "pipeline/multipath/apply.h"
#include "pipeline/testing/multipath_images.h"
#include "pipeline/testing/test_scene.h"
#include "scenes/devices/device.h"

namespace dressform {
namespace {

using namespace multipath_test;
using namespace test_scene;

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

Captured captured_anew(double strength, const std::string& model) {
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

// What four sensors and a scan capture with `strength` times the predicted errors: made once, since light that bounces
// from everywhere to everywhere takes long. Whoever changes it takes a copy.
const Captured& capture(double strength, const std::string& model = "kinect_v2") {
  static std::map<std::pair<double, std::string>, Captured> made;
  const auto [found, is_new] = made.try_emplace({strength, model});
  if (is_new) found->second = captured_anew(strength, model);
  return found->second;
}

Captured copy_of(const Captured& captured) {
  Captured result = captured;
  for (auto* shots : {&result.session.naked, &result.session.dressed})
    for (auto& [name, shot] : *shots) shot.depth_mm = shot.depth_mm.clone(), shot.ir = shot.ir.clone();
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
  const Captured &bent = capture(1), &straight = capture(0);
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
    Captured bent = copy_of(capture(1));
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
    const cv::Mat& truth = capture(0).session.dressed.at("k1").depth_mm;
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
    const Captured& captured = capture(1, model);
    Multipath certain = estimate(captured);
    EXPECT_TRUE(certain.scans.empty()) << model;
    certain.shots.factor = 1;  // as if another sensor of the rig had shown bounced light
    expect_same_shots(captured.session, without_multipath(captured.session, captured.calibration, certain));
  }
}

TEST(Multipath, ImagesThatShowNoneKeepTheirBytes) {
  const Captured& captured = capture(0);
  const Multipath found = estimate(captured);
  expect_same_shots(captured.session, without_multipath(captured.session, captured.calibration, found));
  const DepthScan& scan = captured.session.scans.at("scan_naked");
  const DepthScan same =
      without_multipath(scan, captured.calibration.sensors.at("handheld"), found, found.scans.at("scan_naked"));
  for (std::size_t i = 0; i < scan.depth_mm.size(); ++i) EXPECT_TRUE(same_bytes(scan.depth_mm[i], same.depth_mm[i]));
}

TEST(Multipath, TheVariantNoneTakesDepthAsItIs) {
  const Captured& bent = capture(1);
  const Multipath found = EstimateMultipath::at("none").run(bent.session, bent.calibration, {}, 1);
  EXPECT_EQ(found.shots.factor, 0);
  EXPECT_TRUE(found.scans.empty());
}

TEST(Multipath, EmptySmallAndBlindImages) {
  Captured captured = copy_of(capture(1));
  for (auto& [name, shot] : captured.session.naked) shot.depth_mm.setTo(0);
  for (auto& [name, shot] : captured.session.dressed) shot.ir.release(), shot.depth_mm.setTo(0);
  captured.session.scans["scan_naked"].depth_mm.clear();
  const Multipath found = estimate(captured);
  EXPECT_EQ(found.shots.factor, 0);
  EXPECT_EQ(found.scans.at("scan_naked").factor, 0);
}

}  // namespace
}  // namespace dressform
