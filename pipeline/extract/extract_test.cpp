#include "pipeline/extract/extract.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <opencv2/core.hpp>

#include "pipeline/extract/depth_components.h"
#include "pipeline/geometry/floor.h"
#include "pipeline/testing/analytic_scene.h"

namespace dressform {
namespace {

const analytic::AnalyticScene& scene() {
  static const auto made = analytic::make_scene();
  return made;
}

ExtractedViews run(const std::string& variant, const CaptureSession& session) {
  return Extract::at(variant).run(session, scene().calibration, scene().naked, {}, 1);
}

double iou(const cv::Mat& a, const cv::Mat& b) {
  return cv::countNonZero(a & b) / std::max(1.0, static_cast<double>(cv::countNonZero(a | b)));
}

bool same(const cv::Mat& a, const cv::Mat& b) { return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0; }

TEST(Floor, PlaneBelowATable) {
  cv::Mat points(60, 60, CV_32FC3);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x)
      points.at<cv::Vec3f>(y, x) = {x * 0.05f, (y < 30 && x < 45) ? 0.6f : 1.2f + 0.02f * y * 0.05f, y * 0.05f};
  FloorSearch search;
  search.least_inliers = 100;
  const auto floor = find_floor(points, search, 1, 2);
  ASSERT_TRUE(floor);
  EXPECT_NEAR(floor->head<3>().dot(Eigen::Vector3d(0, -1, 0)), 1, 2e-3);
  EXPECT_NEAR((*floor)[3], 1.2, 0.01);
}

TEST(Floor, NoneWithoutPoints) {
  const cv::Mat points(10, 10, CV_32FC3, cv::Scalar::all(std::nanf("")));
  EXPECT_FALSE(find_floor(points, {}, 1, 2));
}

TEST(DepthComponents, JumpsPart) {
  cv::Mat depth(4, 6, CV_32F, cv::Scalar(1000));
  depth.colRange(3, 6) = 1040;
  depth.at<float>(0, 0) = 0;
  const auto found = depth_components(depth, cv::Mat(4, 6, CV_8U, cv::Scalar(255)), 30);
  ASSERT_EQ(found.sizes, (std::vector<int>{11, 12}));
  EXPECT_EQ(found.labels.at<int>(0, 0), -1);
}

// One mixture of colours for all of the body and one for all of the room can't tell skin from a wall of nearly its
// colour: there grabCut's outline lies anywhere in its band, two pixels either way where a limb is nine wide.
double least_iou(const std::string& variant) { return variant == "cluster_grabcut" ? 0.85 : 0.95; }

// The thesis's depth threshold takes the floor round the feet too, and has no outline but the depth pixels'.
void expect_mannequin(const std::string& variant, const std::string& sensor, const cv::Mat& mask) {
  const cv::Mat truth = scene().labels.at(sensor) > 0;
  if (variant != "thesis") {
    EXPECT_GT(iou(mask, truth), least_iou(variant)) << variant << " " << sensor;
    return;
  }
  // At a quarter of the size a limb is three depth pixels wide.
  EXPECT_GT(cv::countNonZero(mask & truth), 0.85 * cv::countNonZero(truth)) << sensor;
  // Only behind the mannequin as k3 sees it there is nothing near but floor: sides see along the wall.
  if (sensor == "k3") {
    EXPECT_LT(cv::countNonZero(mask), 4 * cv::countNonZero(truth));
  }
}

TEST(Extract, MaskIsTheMannequin) {
  for (const auto& variant : Extract::automatic_names()) {
    const auto result = run(variant, scene().session);
    for (const auto& [sensor, masks] : result.views) {
      EXPECT_TRUE(masks.found_naked && masks.found_dressed) << variant << sensor;
      expect_mannequin(variant, sensor, masks.dressed_color);
    }
    ASSERT_TRUE(result.floor_in_sensor.count("k1"));
    EXPECT_NEAR(result.floor_in_sensor.at("k1")[3], 1.25, 0.01);
  }
}

TEST(Extract, WithoutPriorAndInEitherOrderOfThreads) {
  CaptureSession session = scene().session;
  session.prior.reset();
  for (const auto& variant : Extract::automatic_names()) {
    ExtractedViews one;
    {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
      one = run(variant, session);
    }
    const auto many = run(variant, session);
    for (const auto& [sensor, masks] : one.views) {
      EXPECT_TRUE(same(masks.dressed, many.views.at(sensor).dressed));
      EXPECT_TRUE(same(masks.dressed_color, many.views.at(sensor).dressed_color));
      expect_mannequin(variant, sensor, masks.dressed_color);
    }
  }
}

// Two people tracked in every view: the larger is the mannequin. Sides take the depth threshold all the same.
CaptureSession tracked_session() {
  CaptureSession session = scene().session;
  for (auto& [sensor, shot] : session.dressed) {
    shot.body_index = cv::Mat(shot.depth_mm.size(), CV_8U, cv::Scalar(255));
    shot.body_index(cv::Rect(shot.depth_mm.cols / 3, 10, shot.depth_mm.cols / 3, 60)) = 2;
    shot.body_index(cv::Rect(3, 10, 12, 60)) = 0;
  }
  return session;
}

TEST(ThesisExtract, BodyIndexInFrontAndBackDepthAtTheSides) {
  CaptureSession session = tracked_session();
  const auto found = run("thesis", session), untracked = run("thesis", scene().session);
  for (const char* sensor : {"k1", "k3"}) {
    const Shot& shot = session.dressed.at(sensor);
    EXPECT_TRUE(same(found.views.at(sensor).dressed, (shot.body_index == 2) & (shot.depth_mm > 0))) << sensor;
    EXPECT_FALSE(same(found.views.at(sensor).dressed, untracked.views.at(sensor).dressed));
  }
  for (const char* sensor : {"k2", "k4"}) {
    const cv::Mat &depth = session.dressed.at(sensor).depth_mm, &mask = found.views.at(sensor).dressed;
    EXPECT_TRUE(same(mask, untracked.views.at(sensor).dressed)) << sensor;
    double nearest_left = 0, farthest_taken = 0;
    cv::minMaxLoc(depth, nullptr, &farthest_taken, nullptr, nullptr, mask);
    cv::minMaxLoc(depth, &nearest_left, nullptr, nullptr, nullptr, (mask == 0) & (depth > 0));
    EXPECT_LT(farthest_taken, nearest_left) << sensor;  // a threshold, and nothing else
  }
  session.prior.reset();  // then every view that was tracked
  EXPECT_FALSE(same(run("thesis", session).views.at("k2").dressed, untracked.views.at("k2").dressed));
}

TEST(ThesisExtract, WhereNobodyWasTrackedDepthTells) {
  CaptureSession session = scene().session;
  for (auto& [sensor, shot] : session.dressed) shot.body_index = cv::Mat(shot.depth_mm.size(), CV_8U, cv::Scalar(255));
  const auto found = run("thesis", session), untracked = run("thesis", scene().session);
  for (const auto& [sensor, masks] : found.views)
    EXPECT_TRUE(same(masks.dressed, untracked.views.at(sensor).dressed)) << sensor;
}

TEST(Extract, EmptyDepthIsNotFound) {
  CaptureSession session = scene().session;
  // A matrix of its own: zeros assigned at once would be written into the one that the scene shares.
  session.dressed["k2"].depth_mm = cv::Mat(cv::Mat::zeros(session.dressed["k2"].depth_mm.size(), CV_16U));
  session.naked.erase("k3");
  for (const auto& variant : Extract::automatic_names()) {
    const auto result = run(variant, session);
    EXPECT_FALSE(result.views.at("k2").found_dressed);
    EXPECT_EQ(cv::countNonZero(result.views.at("k2").dressed_color), 0);
    EXPECT_FALSE(result.views.at("k3").found_naked);
    EXPECT_TRUE(result.views.at("k3").found_dressed);
  }
}

TEST(Extract, UncalibratedViewIsAnInputError) {
  Calibration calibration = scene().calibration;
  calibration.sensors.erase("k4");
  for (const auto& variant : Extract::automatic_names())
    EXPECT_THROW(Extract::at(variant).run(scene().session, calibration, scene().naked, {}, 1), InputError);
}

}  // namespace
}  // namespace dressform
