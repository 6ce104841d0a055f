#include "pipeline/segment/segment.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "pipeline/common/analytic_scene.h"
#include "pipeline/segment/hem_curve.h"

namespace dressform {
namespace {

using analytic::AnalyticScene;
using analytic::SceneOptions;

Segmentation run(const std::string& variant, const AnalyticScene& scene) {
  const auto extracted = Extract::at("cluster").run(scene.session, scene.calibration, scene.naked, {}, 1);
  return Segment::at(variant).run(scene.session, scene.calibration, scene.naked, extracted, scene.registration, {}, 1);
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

TEST(HemCurve, FollowsASlantedEdgeThroughAGap) {
  cv::Mat nats(100, 36, CV_32F);
  for (int c = 0; c < nats.cols; ++c)
    for (int r = 0; r < nats.rows; ++r) nats.at<float>(r, c) = r >= 50 + 10 * std::cos(2 * M_PI * c / 36) ? 3.f : -3.f;
  nats.colRange(10, 14).setTo(0);
  const auto hem = trace_hem(nats, 1);
  for (int c = 0; c < nats.cols; ++c)
    EXPECT_NEAR(hem[c], 50 + 10 * std::cos(2 * M_PI * c / 36), c >= 10 && c < 14 ? 8 : 1);
}

TEST(Segment, PlainClothes) {
  for (const auto& variant : Segment::names()) {
    const auto found = run(variant, plain());
    expect_labels(plain(), found, 0.85, variant);
    EXPECT_EQ(found.kinds.at("top"), "shirt");
    EXPECT_EQ(found.kinds.at("bottom"), "trousers");
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
  for (const auto& variant : Segment::names()) expect_labels(scene, run(variant, scene), 0.85, variant);
}

TEST(Segment, SkirtIsASkirt) {
  SceneOptions options;
  options.skirt = true;
  const auto scene = analytic::make_scene(options);
  for (const auto& variant : Segment::names()) {
    const auto found = run(variant, scene);
    EXPECT_EQ(found.kinds.at("bottom"), "skirt");
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
  for (const auto& variant : Segment::names()) {
    const auto a = run(variant, shirt_only);
    EXPECT_EQ(a.kinds.count("bottom"), 0u);
    expect_labels(shirt_only, a, 0.85, variant);
    const auto b = run(variant, trousers_only);
    EXPECT_EQ(b.kinds.count("top"), 0u);
    expect_labels(trousers_only, b, 0.85, variant);
  }
}

TEST(Segment, MissingViewsAndNoNakedShots) {
  AnalyticScene scene = plain();
  scene.registration.model_from_sensor.erase("k2");
  scene.registration.converged["k2"] = false;
  scene.session.naked.clear();
  for (const auto& variant : Segment::names()) {
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
  for (const auto& variant : Segment::names()) {
    const auto found = run(variant, scene);
    EXPECT_TRUE(found.kinds.empty());
    for (const auto& [sensor, labels] : found.labels) EXPECT_EQ(cv::countNonZero(labels), 0);
  }
}

TEST(Segment, SameWithOneThread) {
  for (const auto& variant : Segment::names()) {
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
