#include "pipeline/fill/fill.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "pipeline/fill/garment_depth.h"
#include "pipeline/fill/holes.h"
#include "pipeline/testing/analytic_scene.h"
#include "scenes/error.h"
#include "scenes/picks.h"

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

// Shift-map cuts a graph for each of its sixty shifts: a small image shows as much of it in a tenth of the time.
FieldValues cheap(const std::string& variant) {
  return variant == "shiftmap" ? FieldValues{{"most_px", 1000}} : FieldValues{};
}

FilledViews run(const std::string& variant, const Segmentation& segmentation) {
  return Fill::at(variant).run(scene().session, scene().calibration, scene().body, scene().registration, segmentation,
                               cheap(variant), 1);
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
  for (const auto& variant : Fill::automatic_names()) {
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
  for (const auto& variant : Fill::automatic_names()) {
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
  for (const auto& variant : Fill::automatic_names()) {
    const auto filled = run(variant, segmentation);
    EXPECT_EQ(filled.garments.count("bottom"), 0u);
    for (const char* sensor : {"k3", "k4"}) {
      EXPECT_EQ(cv::countNonZero(filled.garments.at("top").at(sensor).mask), 0);
      EXPECT_EQ(cv::countNonZero(filled.garments.at("top").at(sensor).depth_mm), 0);
    }
  }
}

TEST(Fill, SameWithOneThread) {
  for (const auto& variant : Fill::automatic_names()) {
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

// What a person picks in k2: a region round what the arm hides of the shirt, and a block in the middle of it.
Picks picked_in_k2() {
  const FilledViews found = run("random31", true_segmentation());
  const cv::Rect hole = cv::boundingRect(found.garments.at("top").at("k2").mask == 128);
  const cv::Mat shirt = scene().labels.at("k2") == static_cast<int>(Label::top);
  cv::Mat inside;
  cv::distanceTransform(shirt, inside, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  cv::Point middle;
  cv::minMaxLoc(inside, nullptr, nullptr, nullptr, &middle);
  Picks picks;
  picks.regions["region_top_k2"] = cv::Mat::zeros(shirt.size(), CV_8U);
  picks.regions["region_top_k2"](hole) = 255;
  picks.regions["smooth_top_k2"] = cv::Mat::zeros(shirt.size(), CV_8U);
  picks.regions["smooth_top_k2"](cv::Rect(middle - cv::Point(4, 4), cv::Size(9, 9))) = 255;
  return picks;
}

FilledViews run_picked(const Picks& picks, const FieldValues& values = {}) {
  return Fill::at("thesis_random31")
      .run_with_picks(scene().session, scene().calibration, scene().body, scene().registration, true_segmentation(),
                      values, picks, 1);
}

std::set<int> colors_in(const cv::Mat& bgr, const cv::Mat& mask) {
  std::set<int> colors;
  for (int y = 0; y < bgr.rows; ++y)
    for (int x = 0; x < bgr.cols; ++x)
      if (mask.at<uchar>(y, x)) {
        const auto& c = bgr.at<cv::Vec3b>(y, x);
        colors.insert(c[0] | c[1] << 8 | c[2] << 16);
      }
  return colors;
}

TEST(ThesisRandom31, FillsThePickedRegionFromThePickedBlock) {
  const Picks picks = picked_in_k2();
  const FilledViews filled = run_picked(picks);
  const FilledGarment& top = filled.garments.at("top").at("k2");
  const cv::Mat &photograph = scene().session.dressed.at("k2").color, own = scene().labels.at("k2") == 2;
  const cv::Mat &region = picks.regions.at("region_top_k2"), &block = picks.regions.at("smooth_top_k2");
  EXPECT_EQ(cv::norm(top.mask == 128, region & ~own, cv::NORM_INF), 0);
  const auto lent = colors_in(photograph, block), used = colors_in(top.color, top.mask == 128);
  EXPECT_TRUE(std::includes(lent.begin(), lent.end(), used.begin(), used.end()));
  EXPECT_GT(used.size(), lent.size() / 2);  // all of the block, not one of its pixels
  cv::Mat difference;
  cv::absdiff(top.color, photograph, difference);
  difference.setTo(0, top.mask == 128);
  EXPECT_EQ(cv::norm(difference, cv::NORM_INF), 0);
  // Colours alone, and nothing where nothing was picked.
  EXPECT_EQ(cv::countNonZero(top.synthetic), 0);
  EXPECT_EQ(cv::countNonZero(filled.garments.at("top").at("k4").mask == 128), 0);
  const FilledViews with_depth = run_picked(picks, {{"fill_depth", true}});
  EXPECT_GT(cv::countNonZero(with_depth.garments.at("top").at("k2").synthetic), 40);
  EXPECT_EQ(cv::countNonZero(with_depth.garments.at("top").at("k4").synthetic), 0);
}

TEST(ThesisRandom31, SaysWhatIsMissingOrOfAnotherSize) {
  Picks without = picked_in_k2();
  without.regions.erase("smooth_top_k2");
  EXPECT_THROW(run_picked(without), InputError);
  Picks other = picked_in_k2();
  cv::resize(other.regions["region_top_k2"], other.regions["region_top_k2"], {}, 0.5, 0.5);
  try {
    run_picked(other);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("region_top_k2"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace dressform
