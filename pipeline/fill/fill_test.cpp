#include "pipeline/fill/fill.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "pipeline/fill/garment_depth.h"
#include "pipeline/fill/holes.h"
#include "pipeline/testing/analytic_scene.h"

namespace dressform {
namespace {

using analytic::AnalyticScene;

const AnalyticScene& scene() {
  static const auto made = [] {
    analytic::SceneOptions options;
    options.scale = 0.5;
    return analytic::make_scene(options);
  }();
  return made;
}

Segmentation true_segmentation() {
  Segmentation truth;
  truth.labels = scene().labels;
  truth.garments["top"].kind = "shirt";
  truth.garments["bottom"].kind = "trousers";
  return truth;
}

FilledViews run(const std::string& variant, const Segmentation& segmentation) {
  return Fill::at(variant).run(scene().session, scene().calibration, scene().body, scene().registration, segmentation,
                               {}, 1);
}

// Distance of a depth pixel's point to the shirt's surface round the torso, metres.
double off_the_shirt(const std::string& sensor, int x, int y, float depth_mm) {
  const Camera& ir = scene().calibration.sensors.at(sensor).ir;
  const Vector3d p = scene().registration.model_from_sensor.at(sensor) * ir.unproject(Vector2d(x, y), depth_mm / 1000);
  const double t = std::clamp((p.y() - 1.0) / 0.36, 0.0, 1.0);
  const double height = 1.0 + 0.36 * t, radius = 0.135 + 0.015 * t + 0.018;
  return std::abs((p - Vector3d(0, height, 0)).norm() - radius);
}

TEST(Membrane, KeepsALinearFunction) {
  cv::Mat values(20, 20, CV_32F), domain = cv::Mat::zeros(20, 20, CV_8U);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) values.at<float>(y, x) = 3.f * x - 2.f * y + 100;
  domain(cv::Rect(5, 6, 9, 8)) = 255;
  cv::Mat damaged = values.clone();
  damaged.setTo(0, domain);
  EXPECT_LT(cv::norm(membrane(damaged, domain == 0, domain), values, cv::NORM_INF), 0.01);
}

TEST(GarmentDepth, OnlyTheGarmentAndNoEdges) {
  const auto& calibration = scene().calibration.sensors.at("k1");
  const auto shot = labelled_shot(scene().session.dressed.at("k1"), calibration, scene().labels.at("k1"), {});
  const cv::Mat depth = garment_depth(shot, Label::top);
  EXPECT_GT(cv::countNonZero(depth), 1200);
  int far = 0;
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const float z = depth.at<float>(y, x);
      if (z == 0) continue;
      const Vector3d p =
          scene().registration.model_from_sensor.at("k1") * calibration.ir.unproject(Vector2d(x, y), z / 1000);
      far += p.y() < 0.90 || p.y() > 1.56 || p.z() < -0.05;
    }
  }
  EXPECT_EQ(far, 0);
}

TEST(Fill, TheTorsoBehindTheArm) {
  for (const auto& variant : Fill::names()) {
    const auto filled = run(variant, true_segmentation());
    for (const char* sensor : {"k2", "k4"}) {
      const FilledGarment& top = filled.garments.at("top").at(sensor);
      EXPECT_GT(cv::countNonZero(top.mask == 128), 300) << variant << sensor;
      int count = 0, wrong = 0;
      for (int y = 0; y < top.depth_mm.rows; ++y) {
        for (int x = 0; x < top.depth_mm.cols; ++x) {
          if (!top.synthetic.at<uchar>(y, x)) continue;
          ++count;
          wrong += off_the_shirt(sensor, x, y, top.depth_mm.at<float>(y, x)) > 0.015;
        }
      }
      EXPECT_GT(count, 40) << variant << sensor;
      EXPECT_LT(wrong, 0.1 * count) << variant << sensor;
      // The shirt is plain and blue: so is what was filled in. Skin is not.
      const cv::Scalar color = cv::mean(top.color, top.mask == 128);
      EXPECT_GT(color[0], 2 * color[2]) << variant << sensor;
    }
    EXPECT_EQ(cv::countNonZero(filled.garments.at("top").at("k1").synthetic), 0);
  }
}

TEST(Fill, SeenPixelsKeepTheirColoursAndLabels) {
  for (const auto& variant : Fill::names()) {
    const auto filled = run(variant, true_segmentation());
    for (const auto& [sensor, garment] : filled.garments.at("bottom")) {
      const cv::Mat own = scene().labels.at(sensor) == 3;
      EXPECT_EQ(cv::norm(garment.mask == 255, own, cv::NORM_INF), 0);
      cv::Mat difference;
      cv::absdiff(garment.color, scene().session.dressed.at(sensor).color, difference);
      difference.setTo(0, garment.mask == 128);
      EXPECT_EQ(cv::norm(difference, cv::NORM_INF), 0);
    }
  }
}

TEST(Fill, MissingViewAndAbsentGarment) {
  Segmentation segmentation = true_segmentation();
  segmentation.garments.erase("bottom");
  segmentation.labels.erase("k3");
  segmentation.labels["k4"].setTo(0);
  for (const auto& variant : Fill::names()) {
    const auto filled = run(variant, segmentation);
    EXPECT_EQ(filled.garments.count("bottom"), 0u);
    for (const char* sensor : {"k3", "k4"}) {
      EXPECT_EQ(cv::countNonZero(filled.garments.at("top").at(sensor).mask), 0);
      EXPECT_EQ(cv::countNonZero(filled.garments.at("top").at(sensor).depth_mm), 0);
    }
  }
}

TEST(Fill, SameWithOneThread) {
  for (const auto& variant : Fill::names()) {
    FilledViews one;
    {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
      one = run(variant, true_segmentation());
    }
    const auto many = run(variant, true_segmentation());
    for (const auto& [name, views] : one.garments) {
      for (const auto& [sensor, garment] : views) {
        const FilledGarment& other = many.garments.at(name).at(sensor);
        EXPECT_EQ(cv::norm(garment.color, other.color, cv::NORM_INF), 0);
        EXPECT_EQ(cv::norm(garment.depth_mm, other.depth_mm, cv::NORM_INF), 0);
      }
    }
  }
}

}  // namespace
}  // namespace dressform
