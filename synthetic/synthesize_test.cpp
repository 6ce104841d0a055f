#include "synthetic/synthesize.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <opencv2/core.hpp>

namespace dressform {
namespace {

Scene small_scene(const char* group) {
  Scene scene = scaled(read_scene(std::string(DRESSFORM_SOURCE_DIR) + "/scenes/library/" + group + ".toml"), 0.125);
  scene.scan.frames = 3;
  return scene;
}

double difference(const cv::Mat& a, const cv::Mat& b) {
  if (a.empty() && b.empty()) return 0;
  return cv::norm(a, b, cv::NORM_INF);
}

struct Captured {
  CaptureSession session;
  GroundTruth truth;
  std::vector<std::array<int, 2>> progress;
};

// One capture of group 1 without noise, shared by the tests that only look at it.
const Captured& group1() {
  static const Captured captured = [] {
    Scene scene = small_scene("group1");
    scene.sensor_model = {"ideal", {}};
    std::vector<std::array<int, 2>> progress;
    SyntheticCapture capture = synthesize(scene, 1, [&](int done, int total, const std::string& what) {
      EXPECT_FALSE(what.empty());
      progress.push_back({done, total});
    });
    return Captured{std::move(capture.session), std::move(capture.truth), std::move(progress)};
  }();
  return captured;
}

TEST(Synthesize, AllThatASessionHoldsIsThere) {
  const CaptureSession& session = group1().session;
  const Scene scene = small_scene("group1");
  EXPECT_EQ(session.sensors, (std::vector<std::string>{"k1", "k2", "k3", "k4"}));
  for (const auto* shots : {&session.naked, &session.dressed}) {
    ASSERT_EQ(shots->size(), 4u);
    for (const auto& sensor : scene.rig) {
      const Shot& shot = shots->at(sensor.name);
      EXPECT_EQ(shot.color.size(), cv::Size(sensor.calibration.color->width, sensor.calibration.color->height));
      EXPECT_EQ(shot.color.type(), CV_8UC3);
      const cv::Size ir(sensor.calibration.ir.width, sensor.calibration.ir.height);
      EXPECT_EQ(shot.depth_mm.size(), ir);
      EXPECT_EQ(shot.depth_mm.type(), CV_16UC1);
      EXPECT_EQ(shot.ir.size(), ir);
      EXPECT_EQ(shot.body_index.empty(), !sensor.body_tracking);
      EXPECT_EQ(shot.skeleton.has_value(), sensor.body_tracking);
      if (shot.skeleton) {
        EXPECT_EQ(shot.skeleton->size(), 25u);
      }
    }
  }
  EXPECT_EQ(session.scans.at("scan_naked").depth_mm.size(), 3u);
  EXPECT_EQ(session.scans.at("scan_user").depth_mm.size(), 3u);
  EXPECT_TRUE(session.calibration->sensors.count(session.scans.at("scan_user").sensor));
  ASSERT_TRUE(session.prior);
  EXPECT_EQ(session.prior->world_from_sensor.size(), 4u);
}

TEST(Synthesize, TruthIsWhole) {
  const GroundTruth& truth = group1().truth;
  EXPECT_EQ(truth.world_from_sensor.size(), 4u);
  EXPECT_EQ(truth.scan_world_from_sensor.at("scan_naked").size(), 3u);
  EXPECT_TRUE(topology(truth.naked_body).closed());
  EXPECT_TRUE(topology(truth.user_body).closed());
  EXPECT_EQ(truth.rims.at("top").size(), 4u);
  EXPECT_EQ(truth.rims.at("bottom").size(), 3u);
  for (const char* slot : {"top", "bottom"}) {
    const TruthGarment& garment = truth.garments.at(slot);
    ASSERT_EQ(garment.views.size(), garment.mesh.vertices.size());
    int seen = 0;
    for (const int views : garment.views) {
      seen += views > 0;
      EXPECT_LE(views, 4);
    }
    EXPECT_GT(seen, 0.7 * garment.views.size());
    for (const auto& rim : truth.rims.at(slot)) {
      EXPECT_GE(rim.visible, 0);
      EXPECT_LE(rim.visible, 1);
      EXPECT_GT(rim.points.size(), 10u);
    }
  }
  for (const auto& [name, labels] : truth.labels) {
    int counts[4] = {};
    for (int y = 0; y < labels.rows; ++y)
      for (int x = 0; x < labels.cols; ++x) ++counts[labels.at<std::uint8_t>(y, x)];
    for (const int count : counts) EXPECT_GT(count, labels.rows * labels.cols / 300) << name;
  }
}

// Depth points, taken to the world by the true poses, lie on the true surface
// of the body.
TEST(Synthesize, DepthTruthAndCalibrationAgree) {
  const Captured& capture = group1();
  Eigen::AlignedBox3d body;
  for (const auto& v : capture.truth.naked_body.vertices) body.extend(v);
  for (const auto& [name, shot] : capture.session.naked) {
    const SensorCalibration& calibration = capture.session.calibration->sensors.at(name);
    const Isometry3d& world_from_sensor = capture.truth.world_from_sensor.at(name);
    double top = 0;
    int inside = 0;
    for (int y = 0; y < shot.depth_mm.rows; ++y)
      for (int x = 0; x < shot.depth_mm.cols; ++x) {
        const double depth_m = 1e-3 * shot.depth_mm.at<std::uint16_t>(y, x);
        if (depth_m <= 0) continue;
        const Vector3d point =
            world_from_sensor * calibration.ir.unproject({static_cast<double>(x), static_cast<double>(y)}, depth_m);
        EXPECT_GT(point.y(), -0.002);
        if (!body.contains(point) || point.y() < 0.2) continue;
        ++inside;
        top = std::max(top, point.y());
      }
    EXPECT_GT(inside, 100) << name;
    EXPECT_NEAR(top, body.max().y(), 0.05) << name;
  }
}

TEST(Synthesize, SameBytesForAnyThreadCount) {
  SyntheticCapture captures[2];
  for (int threads = 1; threads <= 2; ++threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    captures[threads - 1] = synthesize(small_scene("group4"), 7);
  }
  const CaptureSession &a = captures[0].session, &b = captures[1].session;
  for (const auto& name : a.sensors)
    for (const auto* pair : {"naked", "dressed"}) {
      const Shot& first = pair[0] == 'n' ? a.naked.at(name) : a.dressed.at(name);
      const Shot& second = pair[0] == 'n' ? b.naked.at(name) : b.dressed.at(name);
      EXPECT_EQ(difference(first.color, second.color), 0);
      EXPECT_EQ(difference(first.depth_mm, second.depth_mm), 0);
      EXPECT_EQ(difference(first.ir, second.ir), 0);
      EXPECT_EQ(difference(first.body_index, second.body_index), 0);
    }
  for (const char* scan : {"scan_naked", "scan_user"})
    for (int i = 0; i < 3; ++i) EXPECT_EQ(difference(a.scans.at(scan).depth_mm[i], b.scans.at(scan).depth_mm[i]), 0);
  for (const char* slot : {"top", "bottom"})
    EXPECT_EQ(captures[0].truth.garments.at(slot).views, captures[1].truth.garments.at(slot).views);
}

TEST(Synthesize, ProgressCountsToTheEnd) {
  const auto& progress = group1().progress;
  ASSERT_EQ(progress.size(), 8u + 6u);
  for (int i = 0; i < 14; ++i) EXPECT_EQ(progress[i], (std::array<int, 2>{i + 1, 14}));
}

TEST(Synthesize, BadInputIsNamed) {
  Scene outside = small_scene("group1");
  outside.rig[1].world_from_sensor.translation().x() = 8;
  EXPECT_THROW(synthesize(outside, 1), InputError);
  Scene unknown = small_scene("group1");
  unknown.sensor_model.variant = "sonar";
  EXPECT_THROW(synthesize(unknown, 1), InputError);
  Scene narrow = small_scene("group1");
  narrow.scan.radius_m = 4;
  EXPECT_THROW(synthesize(narrow, 1), InputError);
}

}  // namespace
}  // namespace dressform
