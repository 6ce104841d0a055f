#include "synthetic/synthesize.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
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
  std::optional<Picks> picks;
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
    return Captured{std::move(capture.session), std::move(capture.truth), std::move(capture.picks),
                    std::move(progress)};
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

// Points of picks in the world, by the frame that they are in.
std::vector<Vector3d> in_world(const PickedPoints& picked, const GroundTruth& truth) {
  const auto scan = truth.scan_world_from_sensor.find(picked.frame);
  const Isometry3d pose =
      scan != truth.scan_world_from_sensor.end() ? scan->second.front() : truth.world_from_sensor.at(picked.frame);
  std::vector<Vector3d> points;
  for (const auto& point : picked.points) points.push_back(pose * point);
  return points;
}

double distance_to(const std::vector<Vector3d>& line, const Vector3d& point) {
  double least = 1e9;
  for (const auto& each : line) least = std::min(least, (each - point).norm());
  return least;
}

// As many as the thesis picked, on what they are named after.
TEST(Synthesize, TheOperatorPicksOnTheClothes) {
  const GroundTruth& truth = group1().truth;
  const Picks& picks = group1().picks.value();
  const std::map<std::string, std::pair<int, int>> wanted{{"top", {247, 243}}, {"bottom", {162, 271}}};
  for (const auto& [slot, counts] : wanted) {
    int rims = 0, borders = 0;
    for (const auto& [name, parts] : picks.points) {
      ASSERT_EQ(parts.size(), 1u) << name;
      const int count = static_cast<int>(parts[0].points.size());
      if (name.rfind("rim_" + slot, 0) == 0) rims += count;
      if (name.rfind("border_" + slot, 0) != 0) continue;
      borders += count;
      for (const auto& point : in_world(parts[0], truth))
        EXPECT_LT(distance_to(truth.garments.at(slot).mesh.vertices, point), 0.03) << name;
    }
    EXPECT_EQ(rims, counts.first) << slot;
    EXPECT_EQ(borders, counts.second) << slot;
    for (const auto& rim : truth.rims.at(slot)) {
      if (rim.visible < 0.9) continue;
      double sum = 0;
      const auto points = in_world(picks.points.at("rim_" + slot + "_" + rim.name)[0], truth);
      for (const auto& point : points) sum += distance_to(rim.points, point);
      EXPECT_LT(sum / static_cast<double>(points.size()), 0.006) << slot << " " << rim.name;
    }
  }
  // The trousers' waist is under the shirt: it is picked at the shirt's hem.
  const auto waist = in_world(picks.points.at("rim_bottom_waist")[0], truth);
  double sum = 0;
  for (const auto& point : waist)
    for (const auto& rim : truth.rims.at("top"))
      if (rim.name == "hem") sum += distance_to(rim.points, point);
  EXPECT_LT(sum / static_cast<double>(waist.size()), 0.06);
}

TEST(Synthesize, TheOperatorPicksTheSamePlacesOnBothBodies) {
  const GroundTruth& truth = group1().truth;
  const auto &control = group1().picks->points.at("control"), &target = group1().picks->points.at("target");
  EXPECT_EQ(control[0].frame, "scan_naked");
  EXPECT_EQ(target[0].frame, "scan_user");
  const auto on_naked = in_world(control[0], truth), on_user = in_world(target[0], truth);
  ASSERT_EQ(on_naked.size(), on_user.size());
  EXPECT_GT(on_naked.size(), 60u);  // of 200, from one frame of this short walk
  for (std::size_t i = 0; i < on_naked.size(); ++i) {
    EXPECT_LT(distance_to(truth.naked_body.vertices, on_naked[i]), 0.03);
    EXPECT_LT(distance_to(truth.user_body.vertices, on_user[i]), 0.03);
    EXPECT_LT((on_naked[i] - on_user[i]).norm(), 0.35);
  }
}

TEST(Synthesize, TheOperatorDrawsTheRegionsThatAreSeen) {
  const auto& regions = group1().picks->regions;
  for (const auto& [sensor, labels] : group1().truth.labels) {
    const std::pair<const char*, int> things[] = {{"skin", 1}, {"top", 2}, {"bottom", 3}};
    for (const auto& [thing, label] : things) {
      const cv::Mat truth = labels == label, &drawn = regions.at("label_" + std::string(thing) + "_" + sensor);
      EXPECT_GT(cv::countNonZero(truth & drawn), 0.85 * cv::countNonZero(truth | drawn)) << thing << " " << sensor;
      if (label == 1) continue;
      const cv::Mat &region = regions.at("region_" + std::string(thing) + "_" + sensor),
                    &smooth = regions.at("smooth_" + std::string(thing) + "_" + sensor);
      EXPECT_GT(cv::countNonZero(truth & region), 0.9 * cv::countNonZero(truth)) << thing << " " << sensor;
      EXPECT_EQ(cv::countNonZero(smooth & ~truth), 0) << thing << " " << sensor;
      EXPECT_GE(cv::countNonZero(smooth), 25);
      // An arm hides a part of the clothes in the side views.
      const int hidden = cv::countNonZero(region & ~truth & (labels == 1));
      if (label == 2 && (sensor == "k2" || sensor == "k4")) {
        EXPECT_GT(hidden, 0.05 * cv::countNonZero(truth)) << sensor;
      }
    }
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
  const Picks &one = captures[0].picks.value(), &other = captures[1].picks.value();
  ASSERT_EQ(one.names(), other.names());
  for (const auto& [name, parts] : one.points) EXPECT_EQ(parts[0].points, other.points.at(name)[0].points) << name;
  for (const auto& [name, region] : one.regions) EXPECT_EQ(difference(region, other.regions.at(name)), 0) << name;
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
