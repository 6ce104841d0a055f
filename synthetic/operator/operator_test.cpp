#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "scenes/scene_fields.h"
#include "synthetic/capture/shapes.h"
#include "synthetic/operator/border_picks.h"
#include "synthetic/operator/region_picks.h"

namespace dressform {
namespace {

constexpr double kRadius_m = 0.2, kLow_m = 0.5, kHigh_m = 1.0;

// A skirt that is a tube about the world's upright, with four sensors round it.
struct TubeScene {
  Garment skirt;
  std::vector<SensorSpec> rig;
  std::vector<RaySurface> surfaces;

  TubeScene() {
    constexpr int kRings = 51, kAround = 120;
    Mesh& mesh = skirt.textured.mesh;
    for (int r = 0; r < kRings; ++r)
      for (int i = 0; i < kAround; ++i)
        mesh.vertices.push_back(around(2 * M_PI * i / kAround, kLow_m + (kHigh_m - kLow_m) * r / (kRings - 1)));
    for (int r = 0; r + 1 < kRings; ++r)
      for (int i = 0; i < kAround; ++i) {
        const int a = r * kAround + i, b = r * kAround + (i + 1) % kAround;
        mesh.triangles.emplace_back(a, b, b + kAround);
        mesh.triangles.emplace_back(a, b + kAround, a + kAround);
      }
    skirt.rims = {{"waist", 1, circle(kHigh_m)}, {"hem", 1, circle(kLow_m)}};
    for (int k = 0; k < 4; ++k) {
      SensorSpec sensor;
      sensor.name = "k" + std::to_string(k + 1);
      sensor.calibration.ir = Camera{128, 106, 93, 93, 63.5, 52.5, {}};
      sensor.calibration.color = Camera{480, 270, 268, 268, 239.5, 134.5, {}};
      SensorPlace place;
      place.azimuth_deg = 90 * k;
      sensor.world_from_sensor = world_from_placed_sensor(place);
      rig.push_back(sensor);
    }
    RaySurface cloth;
    cloth.mesh = mesh;
    cloth.label = Label::bottom;
    surfaces = {cloth};
  }
  static Vector3d around(double angle, double y) {
    return {kRadius_m * std::sin(angle), y, kRadius_m * std::cos(angle)};
  }
  static std::vector<Vector3d> circle(double y) {
    std::vector<Vector3d> points;
    for (int i = 0; i < 360; ++i) points.push_back(around(i * M_PI / 180, y));
    return points;
  }
  const SensorSpec& sensor(const std::string& name) const {
    for (const auto& each : rig)
      if (each.name == name) return each;
    throw std::logic_error(name);
  }
  std::vector<Vector3d> world(const Picks& picks, const std::string& name) const {
    const PickedPoints& picked = picks.points.at(name).at(0);
    std::vector<Vector3d> points;
    for (const auto& point : picked.points) points.push_back(sensor(picked.frame).world_from_sensor * point);
    return points;
  }
  static double off_circle(const Vector3d& point, double y) {
    return Vector2d(std::hypot(point.x(), point.z()) - kRadius_m, point.y() - y).norm();
  }
  Picks picked(double click_px, std::map<std::string, Seam>* seams = nullptr) const {
    const RayScene dressed(surfaces);
    const Onlookers eyes(dressed, rig, click_px, 1);
    Picks picks;
    std::map<std::string, Seam> own;
    pick_rims({{"bottom", &skirt}}, eyes, picks, seams ? *seams : own);
    pick_borders({{"bottom", &skirt}}, own, eyes, picks);
    return picks;
  }
};

RaySurface box(const Vector3d& low, const Vector3d& high) {
  RaySurface surface;
  surface.mesh = box_mesh(low, high);
  return surface;
}

TEST(Operator, StepsAreEqualAndShared) {
  const std::vector<Vector3d> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const auto closed = resampled(square, true, 8);
  ASSERT_EQ(closed.size(), 8u);
  for (int i = 0; i < 4; ++i) EXPECT_LT((closed[2 * i] - square[i]).norm(), 1e-12);
  EXPECT_LT((closed[7] - Vector3d(0, 0.5, 0)).norm(), 1e-12);
  const auto open = resampled(square, false, 4);
  EXPECT_LT((open.back() - square.back()).norm(), 1e-12);
  EXPECT_LT((open[1] - square[1]).norm(), 1e-12);
  EXPECT_EQ(shared_out(247, {1, 1, 2}, 3), (std::vector<int>{62, 62, 123}));
  EXPECT_EQ(shared_out(10, {0.01, 1}, 3), (std::vector<int>{3, 10}));
}

TEST(Operator, AClickMissesAcrossTheLineOfSight) {
  double sum = 0, along = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d error = clicked({1, 2, 3}, Vector3d::UnitX(), 0.01, 1, 2, i) - Vector3d(1, 2, 3);
    sum += error.squaredNorm();
    along = std::max(along, std::abs(error.x()));
  }
  EXPECT_NEAR(std::sqrt(sum / 4000), 0.01, 0.0005);
  EXPECT_LT(along, 1e-12);
}

TEST(Operator, ASteadyHandPicksTheRims) {
  const TubeScene scene;
  const Picks picks = scene.picked(0);
  std::size_t count = 0;
  for (const auto& [name, y] : {std::pair("rim_bottom_waist", kHigh_m), std::pair("rim_bottom_hem", kLow_m)}) {
    const auto points = scene.world(picks, name);
    count += points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_LT(scene.off_circle(points[i], y), 1e-4);
      EXPECT_NEAR((points[i] - points[(i + 1) % points.size()]).norm(), 2 * M_PI * kRadius_m / points.size(), 2e-4);
    }
  }
  EXPECT_EQ(count, 162u);
}

// 1.5 px of a camera of focal length 268 px, 1.9 to 2.1 m away, are 10.6 to 11.8 mm on each of two axes.
TEST(Operator, AnUnsteadyHandMissesByItsPixels) {
  const TubeScene scene;
  const auto meant = scene.world(scene.picked(0), "rim_bottom_hem"),
             hit = scene.world(scene.picked(1.5), "rim_bottom_hem");
  double sum = 0;
  for (std::size_t i = 0; i < meant.size(); ++i) sum += (hit[i] - meant[i]).squaredNorm();
  EXPECT_NEAR(std::sqrt(sum / (2.0 * meant.size())), 0.0112, 0.002);
}

// A pillar hides 48 degrees of the front from the sensor before it, boards hide them from those at the sides: the line
// goes on round the tube.
TEST(Operator, WhatIsHiddenIsBridgedByAnArc) {
  TubeScene scene;
  scene.surfaces.push_back(box({-0.08, 0, 0.24}, {0.08, 2, 0.3}));
  for (const double x : {-0.22, 0.21}) scene.surfaces.push_back(box({x, 0, 0.08}, {x + 0.01, 2, 0.3}));
  const RayScene dressed(scene.surfaces);
  const auto seen = Onlookers(dressed, scene.rig, 0, 1).best(TubeScene::circle(kLow_m));
  EXPECT_GT(std::count(seen.begin(), seen.end(), -1), 20);
  const Picks picks = scene.picked(0);
  for (const auto& point : scene.world(picks, "rim_bottom_hem")) EXPECT_LT(scene.off_circle(point, kLow_m), 0.006);
}

TEST(Operator, ARimThatNobodySeesIsNotPicked) {
  TubeScene scene;
  scene.surfaces.push_back(box({-0.5, kLow_m - 0.05, -0.5}, {0.5, kLow_m + 0.05, 0.5}));
  const Picks picks = scene.picked(0);
  EXPECT_EQ(picks.points.count("rim_bottom_hem"), 0u);
  EXPECT_EQ(picks.points.count("rim_bottom_waist"), 1u);
}

// A top's hem hangs over the waist: the waist is picked where the hem hides the cloth.
TEST(Operator, AWaistUnderAHemIsPickedAtTheHem) {
  const TubeScene scene;
  Garment shirt = scene.skirt;
  shirt.textured.mesh.vertices.clear();
  for (const auto& v : scene.skirt.textured.mesh.vertices)
    shirt.textured.mesh.vertices.emplace_back(1.1 * v.x(), v.y() + 0.3, 1.1 * v.z());
  std::vector<Vector3d> hem;
  for (const auto& p : TubeScene::circle(kLow_m + 0.3)) hem.emplace_back(1.1 * p.x(), p.y(), 1.1 * p.z());
  shirt.rims = {{"neck", 1, TubeScene::circle(kHigh_m + 0.3)}, {"hem", 1, hem}};
  auto surfaces = scene.surfaces;
  surfaces.push_back({});
  surfaces.back().mesh = shirt.textured.mesh;
  const RayScene dressed(surfaces);
  const Onlookers eyes(dressed, scene.rig, 0, 1);
  const WornGarments worn{{"bottom", &scene.skirt}, {"top", &shirt}};
  Picks picks;
  std::map<std::string, Seam> seams;
  pick_rims(worn, eyes, picks, seams);
  pick_borders(worn, seams, eyes, picks);
  ASSERT_EQ(seams.count("bottom"), 1u);
  for (const auto& point : scene.world(picks, "rim_bottom_waist"))
    EXPECT_LT(scene.off_circle(point, kLow_m + 0.3), 0.012);
  for (const auto& point : scene.world(picks, "border_bottom_front_left")) EXPECT_LT(point.y(), kLow_m + 0.31);
  EXPECT_EQ(picks.points.count("rim_top_hem"), 1u);
}

TEST(Operator, BordersRunUpwardsHalfWayBetweenTheViews) {
  const TubeScene scene;
  const Picks picks = scene.picked(0);
  std::size_t count = 0;
  const std::map<std::string, double> wanted{
      {"front_left", 45}, {"front_right", -45}, {"back_left", 135}, {"back_right", -135}};
  for (const auto& [name, azimuth_deg] : wanted) {
    const auto points = scene.world(picks, "border_bottom_" + name);
    count += points.size();
    EXPECT_NEAR(points.front().y(), kLow_m, 0.002);
    EXPECT_NEAR(points.back().y(), kHigh_m, 0.002);
    for (const auto& point : points) {
      EXPECT_NEAR(std::atan2(point.x(), point.z()) * 180 / M_PI, azimuth_deg, 1) << name;
      EXPECT_NEAR(std::hypot(point.x(), point.z()), kRadius_m, 0.001);
    }
  }
  EXPECT_EQ(count, 271u);
}

// The block lies where the cloth is even; an arm's skin in front of the cloth is part of its outline.
TEST(Operator, RegionsReachBehindAnArmAndTheBlockIsTheSmoothestOne) {
  const TubeScene scene;
  const SensorSpec& front = scene.rig[0];
  const cv::Size size(480, 270);
  cv::Mat labels(size, CV_8UC1, cv::Scalar(0)), color(size, CV_8UC3);
  cv::RNG(1).fill(color, cv::RNG::UNIFORM, 0, 255);
  const cv::Rect cloth(220, 175, 40, 45), arm(235, 175, 6, 45), even(245, 185, 12, 31);
  labels(cloth) = 3;
  labels(arm) = 1;
  color(even) = cv::Scalar(90, 80, 70);
  Picks picks;
  draw_regions({{"bottom", &scene.skirt}}, {front}, {{"k1", labels}}, {{"k1", Shot{color, {}, {}, {}, {}}}}, 0, 1,
               picks);
  EXPECT_EQ(cv::countNonZero(picks.regions.at("region_bottom_k1")(arm)), arm.area());
  EXPECT_EQ(cv::countNonZero(picks.regions.at("label_bottom_k1")(cv::Rect(237, 180, 2, 30))), 0);
  EXPECT_EQ(picks.regions.count("region_top_k1"), 0u);
  const cv::Mat& smooth = picks.regions.at("smooth_bottom_k1");  // 31 does not fit beside the arm, 15 does
  EXPECT_EQ(cv::countNonZero(smooth & (labels != 3)), 0);
  EXPECT_EQ(cv::countNonZero(smooth), 15 * 15);
  EXPECT_GE(cv::countNonZero(smooth(even)), 12 * 14);
}

}  // namespace
}  // namespace dressform
