#include "eval/gate/power/fault.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "eval/gate/power/power_run.h"
#include "eval/testing/test_meshes.h"
#include "pipeline/correct/correct.h"
#include "pipeline/reconstruct.h"
#include "scenes/error.h"

namespace dressform {
namespace {

// Small results of every stage, with all that faults reach for.
Mesh sleeve() { return test_meshes::tube(0.1, 0.08, {0, 0, 0}, 0.2, 1, 24, 16, false); }

TexturedMesh printed_sleeve() {
  TexturedMesh mesh;
  mesh.mesh = sleeve();
  mesh.corner_uv.assign(mesh.mesh.triangles.size(), {Vector2f(0, 0), Vector2f(1, 0), Vector2f(0, 1)});
  mesh.texture = cv::Mat(256, 256, CV_8UC3);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x)
      mesh.texture.at<cv::Vec3b>(y, x) = cv::Vec3b(40 + x / 4, 120 + y / 8, x % 32 < 16 ? 60 : 220);
  return mesh;
}

cv::Mat striped_labels() {
  cv::Mat labels = cv::Mat::zeros(120, 80, CV_8UC1);
  cv::rectangle(labels, cv::Rect(20, 10, 40, 50), cv::Scalar(2), cv::FILLED);
  cv::rectangle(labels, cv::Rect(20, 60, 40, 50), cv::Scalar(3), cv::FILLED);
  return labels;
}

GarmentLayouts some_layouts() {
  GarmentLayouts layouts;
  layouts["top"].kind = "shirt";
  layouts["top"].arms[0] = {true, 0.2, 0.02, 0};
  return layouts;
}

std::string bytes_of_images(const std::string& stage) {
  if (stage == "segment") return to_bytes(Segmentation{{{"k1", striped_labels()}}, some_layouts()});
  if (stage == "fill") {
    FilledGarment filled;
    filled.color = cv::Mat(120, 80, CV_8UC3, cv::Scalar(30, 60, 90));
    filled.mask = (striped_labels() == 2);
    filled.depth_mm = cv::Mat(60, 40, CV_32FC1, cv::Scalar(2000));
    filled.synthetic = cv::Mat::zeros(60, 40, CV_8UC1);
    return to_bytes(FilledViews{{{"top", {{"k1", filled}}}}});
  }
  ExtractedViews extracted;
  for (const char* sensor : {"k1", "k2", "k3", "k4"}) {
    const cv::Mat mask = striped_labels() > 0;
    extracted.views[sensor] = {mask.clone(), mask.clone(), mask.clone(), mask.clone(), true, true};
  }
  return to_bytes(extracted);
}

std::string bytes_of_cameras(const std::string& stage) {
  if (stage == "multipath") return to_bytes(Multipath{});
  if (stage == "registration") {
    Registration registration;
    for (int k = 0; k < 4; ++k) {
      Isometry3d pose = Isometry3d::Identity();
      pose.translation() = Vector3d(2.0 * k, 1, 2);
      registration.model_from_sensor["k" + std::to_string(k + 1)] = pose;
    }
    return to_bytes(registration);
  }
  Calibrated calibrated;
  SensorCalibration sensor;
  sensor.color = Camera{};
  sensor.ir.fx = sensor.ir.fy = 365;
  calibrated.calibration.sensors = {{"handheld", SensorCalibration{}}, {"k1", sensor}};
  return to_bytes(calibrated);
}

std::string bytes_of_meshes(const std::string& stage) {
  if (stage == "fuse") {
    BodyModel model;
    model.body = sleeve();
    return to_bytes(model);
  }
  if (stage == "surface") return to_bytes(ClosedGarments{{{"top", {sleeve(), {}, {}}}}});
  if (stage == "open") return to_bytes(OpenGarments{{{"top", {sleeve(), {}, {}}}}, {}});
  if (stage == "texture") return to_bytes(TexturedGarments{{{"top", printed_sleeve()}}, {}});
  if (stage == "fit") {
    FittedGarments fitted;
    fitted.garments["top"] = printed_sleeve();
    return to_bytes(fitted);
  }
  if (stage == "correct") {
    CorrectedGarments corrected;
    corrected.garments["top"] = printed_sleeve();
    return to_bytes(corrected);
  }
  Landmarks landmarks;
  landmarks.triangle_parts = {BodyPart::left_arm, BodyPart::torso, BodyPart::right_leg};
  return to_bytes(landmarks);
}

std::string some_bytes(const std::string& step) {
  const std::string stage = stage_of_step(step);
  if (stage == "segment" || stage == "fill" || stage == "extract") return bytes_of_images(stage);
  if (stage == "multipath" || stage == "registration" || stage == "calibrate") return bytes_of_cameras(stage);
  return bytes_of_meshes(stage);
}

TEST(Faults, AreAtLeastFortyOverAllStagesAndTheScorerWithNamesOfTheirOwn) {
  std::set<std::string> ids, stages;
  for (const auto& fault : all_faults()) {
    EXPECT_TRUE(ids.insert(fault.id()).second) << fault.id();
    stages.insert(stage_of_step(fault.step));
    EXPECT_FALSE(fault.unit.empty() || fault.what.empty()) << fault.id();
    const int functions =
        !!fault.on_artifact + !!fault.on_capture + !!fault.on_scorer + !!fault.on_scores + !!fault.on_image;
    EXPECT_EQ(functions, 1) << fault.id();
    EXPECT_TRUE(fault.sizes.size() == 1 || fault.sizes.size() == 3) << fault.id();
    for (std::size_t k = 1; k < fault.sizes.size(); ++k)
      EXPECT_GT(std::abs(fault.sizes[k]), std::abs(fault.sizes[k - 1])) << fault.id();
  }
  EXPECT_GE(ids.size(), 40u);
  for (const auto& stage : describe_stages()) EXPECT_TRUE(stages.count(stage.name)) << stage.name;
  for (const char* other : {"capture", "scores", "image"}) EXPECT_TRUE(stages.count(other)) << other;
}

TEST(Faults, OfStagesChangeTheirResultTheSameWayEveryTimeAndOtherwiseInAnotherSize) {
  for (const auto& fault : all_faults()) {
    if (!fault.on_artifact) continue;
    const std::string before = some_bytes(fault.step);
    const Placement place(1, fault.id());
    const std::string large = fault.on_artifact(before, fault.sizes.back(), place);
    EXPECT_NE(large, before) << fault.id();
    EXPECT_EQ(large, fault.on_artifact(before, fault.sizes.back(), place)) << fault.id();
    if (fault.sizes.size() == 3) {
      EXPECT_NE(large, fault.on_artifact(before, fault.sizes[1], place)) << fault.id();
    }
  }
}

TEST(Faults, OfPicturesAndNumbersChangeThem) {
  for (const auto& fault : all_faults()) {
    const Placement place(1, fault.id());
    if (fault.on_image) {
      cv::Mat image = printed_sleeve().texture, difference;
      fault.on_image(image, fault.sizes.back(), place);
      cv::absdiff(image, printed_sleeve().texture, difference);
      EXPECT_GT(cv::countNonZero(difference.reshape(1)), 0) << fault.id();
    }
    if (fault.on_scores) {
      Scores scores{
          "s", "v", 1, {{"surface", "top/f_5mm@1", "1", 0.9, "ok", 1}, {"surface", "top/hd95_mm@1", "mm", 9, "ok", 1}}};
      const std::string before = scores_to_json(scores);
      fault.on_scores(scores, fault.sizes.back(), place);
      EXPECT_NE(scores_to_json(scores), before) << fault.id();
    }
  }
}

TEST(Faults, MoveAViewByTheirSize) {
  const auto fault = chosen_faults({"registration.view_moved"}).at(0);
  const auto before = from_bytes<Registration>(some_bytes("registration"));
  const auto after = from_bytes<Registration>(fault.on_artifact(some_bytes("registration"), 5, {2, fault.id()}));
  int moved = 0;
  for (const auto& [sensor, pose] : before.model_from_sensor) {
    const double by = (after.model_from_sensor.at(sensor).translation() - pose.translation()).norm();
    moved += by > 0;
    if (by > 0) {
      EXPECT_NEAR(by, 0.005, 1e-12);
    }
  }
  EXPECT_EQ(moved, 1);
}

TEST(Faults, OfOneCaptureTouchOneSensorByTheirSize) {
  CaptureSession session;
  for (const char* sensor : {"k1", "k2"}) {
    session.dressed[sensor].depth_mm = cv::Mat(4, 5, CV_16UC1, cv::Scalar(2000));
    session.dressed[sensor].depth_mm.at<std::uint16_t>(0, 0) = 0;
  }
  const auto fault = chosen_faults({"capture.depth_long"}).at(0);
  fault.on_capture(session, 10, {1, fault.id()});
  int longer = 0;
  for (const auto& [sensor, shot] : session.dressed) {
    longer += shot.depth_mm.at<std::uint16_t>(2, 2) == 2010;
    EXPECT_EQ(shot.depth_mm.at<std::uint16_t>(0, 0), 0) << "what was not seen is not made up";
  }
  EXPECT_EQ(longer, 1);
}

TEST(Faults, AreChosenByNameOrStepAndOthersRefused) {
  EXPECT_EQ(chosen_faults({"open.hole"}).size(), 1u);
  EXPECT_GT(chosen_faults({"segment"}).size(), 3u);
  EXPECT_EQ(chosen_faults({}).size(), all_faults().size());
  EXPECT_THROW(chosen_faults({"segment.nothing"}), InputError);
  EXPECT_EQ(size_word(chosen_faults({"open.hole"})[0], 0), "small");
  EXPECT_EQ(size_word(chosen_faults({"open.hole"})[0], 2), "large");
  EXPECT_EQ(size_word(chosen_faults({"correct.lost"})[0], 0), "large");
}

}  // namespace
}  // namespace dressform
