#include "pipeline/segment/segment.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/testing/analytic_scene.h"

namespace dressform {
namespace {

using analytic::AnalyticScene;
using analytic::SceneOptions;

Segmentation run(const std::string& variant, const AnalyticScene& scene) {
  const auto extracted = Extract::at("cluster").run(scene.session, scene.calibration, scene.naked, {}, 1);
  return Segment::at(variant).run(scene.session, scene.calibration, scene.body, extracted, scene.registration, {}, 1);
}

void expect_labels(const AnalyticScene& scene, const Segmentation& found, double least, const std::string& what) {
  for (const auto& [sensor, truth] : scene.labels)
    for (const int label : {1, 2, 3})
      EXPECT_GT(analytic::label_iou(found.labels.at(sensor), truth, label), least)
          << what << " " << sensor << " " << label;
}

const AnalyticScene& plain() {
  static const auto made = analytic::make_scene();
  return made;
}

std::map<std::string, std::string> kinds(const Segmentation& found) {
  std::map<std::string, std::string> result;
  for (const auto& [name, layout] : found.garments) result[name] = layout.kind;
  return result;
}

// jseg_auto and those that differ from it in how they find regions alone: all name them by named_regions. What their
// names follow from is tested with jseg_auto for all. By colour alone a print falls apart into its figures, each named
// by its own height: no bound holds there for mean_shift, kmeans and gla_mrf.
std::vector<std::string> names_once_each_way() {
  auto names = Segment::automatic_names();
  const auto by_color = [](const std::string& name) {
    return name == "mean_shift" || name == "kmeans" || name == "gla_mrf";
  };
  names.erase(std::remove_if(names.begin(), names.end(), by_color), names.end());
  return names;
}

// Those that part clothes by more than colour and texture. JSEG does not: clothes of nearly one colour are one region
// to it, which the hem crosses unseen.
std::vector<std::string> names_beyond_color() {
  auto names = names_once_each_way();
  names.erase(std::remove(names.begin(), names.end(), "jseg_auto"), names.end());
  return names;
}

// Each of the variants finds these garments, where they are.
void expect_found(const AnalyticScene& scene, const std::map<std::string, std::string>& expected,
                  const std::vector<std::string>& variants) {
  for (const auto& variant : variants) {
    const auto found = run(variant, scene);
    EXPECT_EQ(kinds(found), expected) << variant;
    expect_labels(scene, found, 0.85, variant);
  }
}

TEST(Segment, PlainClothes) {
  for (const auto& variant : Segment::automatic_names()) {
    const auto found = run(variant, plain());
    expect_labels(plain(), found, 0.85, variant);
    const GarmentLayout &top = found.garments.at("top"), &bottom = found.garments.at("bottom");
    EXPECT_EQ(top.kind, "shirt");
    EXPECT_EQ(bottom.kind, "trousers");
    EXPECT_GT(bottom.sure_kind, 0.5);
    EXPECT_NEAR(top.bottom_y, 0.93, 0.03);
    for (int side = 0; side < 2; ++side) {
      EXPECT_TRUE(top.arms[side].covered && bottom.legs[side].covered);
      const Limb& arm = *plain().body.landmarks.arm(side);
      EXPECT_NEAR(arm.root.y() + top.arms[side].end_m * arm.direction.y(), 1.2, 0.04);  // where sleeves end
      // At a quarter of the size the ankles' labels end some 6 cm early: 12 mm of ease are four pixels' noise there.
      EXPECT_NEAR(bottom.legs[side].end_y, 0.15, 0.08);
    }
  }
}

TEST(Segment, PrintsWithTheOtherGarmentsColours) {
  SceneOptions options;
  options.top_color = [](const Vector3d& p) {
    const bool spot = std::sin(60 * p.x()) * std::sin(60 * p.y()) * std::cos(50 * p.z()) > 0.45;
    const bool stripe = std::abs(p.y() - 1.25) < 0.02;
    return stripe ? cv::Vec3b(200, 210, 220) : spot ? cv::Vec3b(60, 50, 50) : cv::Vec3b(40, 60, 25);
  };
  options.bottom_color = [](const Vector3d&) { return cv::Vec3b(60, 35, 28); };
  const auto scene = analytic::make_scene(options);
  for (const auto& variant : names_beyond_color()) expect_labels(scene, run(variant, scene), 0.85, variant);
}

// Where k1 sees the chest below the neck: |x| < 0.12 m on the figure, 1.26 < y < 1.36.
cv::Mat yoke_of(const AnalyticScene& scene) {
  const auto& sensor = scene.calibration.sensors.at("k1");
  const Isometry3d color_from_model = sensor.color_from_ir * scene.registration.model_from_sensor.at("k1").inverse();
  cv::Mat mask = cv::Mat::zeros(scene.labels.at("k1").size(), CV_8U);
  std::vector<cv::Point> corners;
  for (const Vector3d& corner : {Vector3d(-0.12, 1.26, 0.15), Vector3d(-0.12, 1.36, 0.15), Vector3d(0.12, 1.36, 0.15),
                                 Vector3d(0.12, 1.26, 0.15)}) {
    const Vector2d pixel = sensor.color->project(color_from_model * corner);
    corners.emplace_back(cvRound(pixel.x()), cvRound(pixel.y()));
  }
  cv::fillConvexPoly(mask, corners, cv::Scalar(255));
  return mask;
}

// Large figures of the skin's own colour and a yoke of nearly that, on cloth 7 mm off the skin: colour says skin, and
// no one pixel's depth says otherwise.
TEST(Segment, PrintOfTheSkinsColour) {
  SceneOptions options;
  options.shirt_ease_m = 0.007;
  options.top_color = [](const Vector3d& p) {
    const bool figure = std::hypot(p.x() - 0.04, p.y() - 1.17) < 0.05 || std::hypot(p.x() + 0.06, p.y() - 1.08) < 0.04;
    const bool yoke = p.y() > 1.26 && std::abs(p.x()) < 0.12;
    if (yoke) return cv::Vec3b(160, 190, 222);
    return figure ? cv::Vec3b(175, 195, 215) : cv::Vec3b(150, 60, 30);
  };
  const auto scene = analytic::make_scene(options);
  const auto extracted = Extract::at("cluster").run(scene.session, scene.calibration, scene.naked, {}, 1);
  const auto found = [&](const FieldValues& values) -> cv::Mat {
    return Segment::at("joint_mrf")
               .run(scene.session, scene.calibration, scene.body, extracted, scene.registration, values, 1)
               .labels.at("k1") == 2;
  };
  const cv::Mat truth = scene.labels.at("k1") == 2, yoke = truth & yoke_of(scene);
  const auto part_of = [](const cv::Mat& mask, const cv::Mat& whole) {
    return static_cast<double>(cv::countNonZero(mask & whole)) / cv::countNonZero(whole);
  };
  const cv::Mat with = found({}), without = found({{"raised_mm", 100.0}});
  EXPECT_GT(part_of(with, truth), 0.96);
  EXPECT_GT(part_of(with, yoke), 0.9);
  EXPECT_LT(part_of(without, truth), 0.92) << "the figures are too small to matter";
  EXPECT_LT(part_of(without, yoke), 0.15) << "colour alone finds the yoke";
}

TEST(Segment, SkirtIsASkirt) {
  SceneOptions options;
  options.skirt = true;
  const auto scene = analytic::make_scene(options);
  for (const auto& variant : names_once_each_way()) {
    const auto found = run(variant, scene);
    EXPECT_EQ(found.garments.at("bottom").kind, "skirt");
    expect_labels(scene, found, 0.85, variant);
  }
}

TEST(Segment, AbsentGarments) {
  SceneOptions options;
  options.bottom = false;
  const auto shirt_only = analytic::make_scene(options);
  options.bottom = true;
  options.top = false;
  const auto trousers_only = analytic::make_scene(options);
  for (const auto& variant : names_once_each_way()) {
    const auto a = run(variant, shirt_only);
    EXPECT_EQ(kinds(a), (std::map<std::string, std::string>{{"top", "shirt"}}));
    expect_labels(shirt_only, a, 0.85, variant);
    const auto b = run(variant, trousers_only);
    EXPECT_EQ(b.garments.count("top"), 0u);
    expect_labels(trousers_only, b, 0.85, variant);
  }
}

// Figures of several colours that stand anywhere on the cloth.
cv::Vec3b strewn(const Vector3d& p) {
  const double wave = std::sin(55 * p.x() + 3) * std::sin(60 * p.y()) * std::cos(50 * p.z());
  if (wave > 0.35) return std::sin(17 * p.y() + 23 * p.x()) > 0 ? cv::Vec3b(40, 40, 170) : cv::Vec3b(210, 200, 60);
  return {60, 110, 50};
}

TEST(Segment, DressIsOneGarmentWhateverItsPrint) {
  const auto plaid = [](const Vector3d& p) {
    const int bands = (std::fmod(p.y() + 9, 0.09) < 0.03) + (std::fmod(std::atan2(p.x(), p.z()) + 9, 0.5) < 0.15);
    return bands == 0 ? cv::Vec3b(120, 60, 60) : bands == 1 ? cv::Vec3b(60, 60, 130) : cv::Vec3b(40, 160, 190);
  };
  SceneOptions options;
  options.dress = true;
  for (const auto& print : {std::function<cv::Vec3b(const Vector3d&)>(strewn), {plaid}}) {
    options.top_color = print;
    const auto scene = analytic::make_scene(options);
    expect_found(scene, {{"top", "dress"}}, names_once_each_way());
  }
}

TEST(Segment, SkirtOfNearlyTheShirtsColourIsItsOwnGarment) {
  SceneOptions options;
  options.skirt = true;
  options.top_color = [](const Vector3d&) { return cv::Vec3b(40, 60, 25); };
  options.bottom_color = [](const Vector3d&) { return cv::Vec3b(60, 38, 28); };
  const auto scene = analytic::make_scene(options);
  expect_found(scene, {{"top", "shirt"}, {"bottom", "skirt"}}, names_beyond_color());
}

// Legs say that there are two garments, and the shirt's edge says where they meet.
TEST(Segment, TrousersOfTheShirtsColour) {
  SceneOptions options;
  options.top_color = options.bottom_color = [](const Vector3d&) { return cv::Vec3b(150, 60, 30); };
  options.shirt_ease_m = 0.022;
  const auto scene = analytic::make_scene(options);
  expect_found(scene, {{"top", "shirt"}, {"bottom", "trousers"}}, names_beyond_color());
}

// Below a printed shirt, a hand's width of shorts: 15 pixels here; at the sides the hands hang before it, and what they
// leave is too narrow to be a region of JSEG.
TEST(Segment, BottomOfWhichLittleShows) {
  SceneOptions options;
  options.top_color = strewn;
  options.leg_end_y_m = 0.83;
  const auto scene = analytic::make_scene(options);
  for (const auto& variant : names_once_each_way()) {
    const auto found = run(variant, scene);
    EXPECT_EQ(found.garments.count("bottom"), 1u);
    for (const auto& [sensor, truth] : scene.labels) {
      const bool side = sensor == "k2" || sensor == "k4";
      EXPECT_GT(analytic::label_iou(found.labels.at(sensor), truth, 2), 0.85) << variant << sensor;
      if (side && variant == "jseg_auto") continue;
      EXPECT_GT(analytic::label_iou(found.labels.at(sensor), truth, 3), side ? 0.5 : 0.8) << variant << sensor;
    }
  }
}

TEST(Segment, MissingViewsAndNoNakedShots) {
  AnalyticScene scene = plain();
  scene.registration.model_from_sensor.erase("k2");
  scene.registration.converged["k2"] = false;
  scene.session.naked.clear();
  for (const auto& variant : names_once_each_way()) {
    const auto found = run(variant, scene);
    EXPECT_EQ(cv::countNonZero(found.labels.at("k2")), 0);
    for (const char* sensor : {"k1", "k3", "k4"})
      for (const int label : {2, 3})
        EXPECT_GT(analytic::label_iou(found.labels.at(sensor), scene.labels.at(sensor), label), 0.8) << sensor << label;
  }
}

TEST(Segment, NothingToSee) {
  AnalyticScene scene = plain();
  for (auto& [sensor, shot] : scene.session.dressed) shot.depth_mm = cv::Mat::zeros(shot.depth_mm.size(), CV_16U);
  for (const auto& variant : Segment::automatic_names()) {
    const auto found = run(variant, scene);
    EXPECT_TRUE(found.garments.empty());
    for (const auto& [sensor, labels] : found.labels) EXPECT_EQ(cv::countNonZero(labels), 0);
  }
}

TEST(Segment, SameWithOneThread) {
  for (const auto& variant : Segment::automatic_names()) {
    Segmentation one;
    {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
      one = run(variant, plain());
    }
    const auto many = run(variant, plain());
    for (const auto& [sensor, labels] : one.labels)
      EXPECT_EQ(cv::norm(labels, many.labels.at(sensor), cv::NORM_INF), 0) << variant << sensor;
  }
}

}  // namespace
}  // namespace dressform
