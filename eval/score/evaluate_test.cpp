#include "eval/score/evaluate.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <opencv2/core.hpp>
#include <set>

#include "eval/score/held_out.h"
#include "eval/score/metric.h"
#include "eval/testing/judged_figure.h"
#include "scenes/error.h"

namespace dressform {
namespace {

using namespace judged_figure;

TEST(Evaluate, TruthScoresPerfect) {
  const GroundTruth truth = some_truth();
  const Scores scores = evaluate(perfect_outputs(truth), truth, quick());
  for (const char* metric : {"max/rotation_deg@1", "max/translation_mm@1", "max/tre_mm@1"})
    EXPECT_NEAR(value(scores, "registration", metric), 0, 1e-5);
  for (const char* body : {"naked_body", "user_body"}) {
    EXPECT_NEAR(value(scores, "fuse", body + std::string("/chamfer_l1_mm@1")), 0, 1e-6);
    EXPECT_EQ(value(scores, "fuse", body + std::string("/closed@1")), 1);
  }
  for (const std::string slot : {"top", "bottom"}) {
    EXPECT_EQ(value(scores, "surface", slot + "/f_2mm@1"), 1);
    EXPECT_NEAR(value(scores, "surface", slot + "/hausdorff_mm@1"), 0, 1e-6);
    EXPECT_NEAR(value(scores, "surface", slot + "/normal_consistency_signed@1"), 1, 1e-9);
    EXPECT_EQ(value(scores, "open", slot + "/loops@1"), 2);
    EXPECT_EQ(value(scores, "open", slot + "/loop_difference@1"), 0);
    EXPECT_EQ(value(scores, "open", slot + "/boundary_identity@1"), 0);
    EXPECT_NEAR(value(scores, "open", slot + "/rims_hd95_mm@1"), 0, 1e-6);
    EXPECT_NEAR(value(scores, "open", slot + "/rims_length_error@1"), 0, 1e-9);
    EXPECT_GT(value(scores, "texture", slot + "/ssim@2"), 0.995);
    EXPECT_GT(value(scores, "texture", slot + "/ssim_observed@2"), 0.995);
    EXPECT_GT(value(scores, "texture", slot + "/ssim_raw@2"), 0.995);
    EXPECT_GT(value(scores, "texture", slot + "/silhouette_iou@2"), 0.995);
    EXPECT_LT(value(scores, "texture", slot + "/de2000_mean@2"), 0.2);
    EXPECT_EQ(value(scores, "segment", "mean/iou_" + slot + "@1"), 1);
    EXPECT_EQ(value(scores, "segment", "mean/boundary_f_" + slot + "@1"), 1);
  }
  EXPECT_EQ(value(scores, "correct", "bottom/penetration_area_cm2@1"), 0);
  EXPECT_EQ(value(scores, "correct", "bottom/intersecting_pairs@1"), 0);
  EXPECT_EQ(value(scores, "segment", "mean/foreground_leakage@1"), 0);
  EXPECT_NEAR(value(scores, "fit", "naked_body/girth_waist_error_mm@2"), 0, 0.5);
  EXPECT_NEAR(value(scores, "fit", "top/edge_stretch_p95@1"), 0.1, 0.005) << "widened by a tenth";
}

TEST(Evaluate, ErrorsOfASensorAreItsOwnAndThoseOfTheGaugeEverybodys) {
  const GroundTruth truth = some_truth();
  RunOutputs outputs = perfect_outputs(truth);
  const Isometry3d nudge = Eigen::Translation3d(0, 0, 0.01) * Isometry3d::Identity();
  outputs.model_from_sensor["k3"] = outputs.model_from_sensor["k3"] * nudge;
  const Scores one = evaluate(outputs, truth, quick());
  EXPECT_NEAR(value(one, "registration", "k3/translation_mm@1"), 10, 1e-6);
  EXPECT_NEAR(value(one, "registration", "k3/tre_mm@1"), 10, 1e-6);
  EXPECT_NEAR(value(one, "registration", "k2/tre_mm@1"), 0, 1e-5);
  EXPECT_NEAR(value(one, "registration", "max/tre_mm@1"), 10, 1e-6);
  EXPECT_EQ(one.find("registration", "k1/tre_mm@1"), nullptr) << "the gauge has no error of its own";
  EXPECT_EQ(value(one, "surface", "top/f_2mm@1"), 1);

  outputs = perfect_outputs(truth);
  outputs.model_from_sensor["k1"] = outputs.model_from_sensor["k1"] * nudge;
  const Scores gauge = evaluate(outputs, truth, quick());
  EXPECT_NEAR(value(gauge, "registration", "k2/translation_mm@1"), 10, 1e-6);
  EXPECT_LT(value(gauge, "surface", "top/f_2mm@1"), 0.7);
  EXPECT_NEAR(value(gauge, "open", "top/rims_hd95_mm@1"), 10, 0.2);
}

TEST(Evaluate, GarmentFaultsShow) {
  const GroundTruth truth = some_truth();
  RunOutputs outputs = perfect_outputs(truth);
  auto& top = outputs.garments["top"];
  top.mesh =
      transformed(tube(0.22, 0.16, {0, 0, 0}, 1.0, 1.4, 64, 25, false), kModelFromWorld.matrix());  // neck cut low
  auto& bottom = outputs.garments["bottom"];
  bottom.mesh =
      transformed(tube(0.21, 0.15, {0, 0, 0}, 0.5, 1.2, 64, 40, true), kModelFromWorld.matrix());  // never opened
  const Scores scores = evaluate(outputs, truth, quick());
  EXPECT_NEAR(value(scores, "open", "top/rim_neck_hd95_mm@1"), 50, 0.1);
  EXPECT_NEAR(value(scores, "open", "top/rims_hd95_mm@1"), 50, 0.1);
  EXPECT_NEAR(value(scores, "open", "top/rims_chamfer_mm@1"), 25, 0.1);
  EXPECT_EQ(value(scores, "open", "bottom/loops@1"), 0);
  EXPECT_EQ(value(scores, "open", "bottom/loop_difference@1"), 2);
  EXPECT_NE(value(scores, "open", "bottom/boundary_identity@1"), 0);
  EXPECT_EQ(value(scores, "open", "bottom/rims_hd95_mm@1"), 200) << "the penalty of an unmatched rim";
  EXPECT_EQ(status(scores, "open", "bottom/rim_hem_hd95_mm@1"), "failed");
  EXPECT_EQ(status(scores, "fit", "top/edge_stretch_p95@1"), "failed") << "other triangles than the fitted one";
}

TEST(Evaluate, UnobservedRimsAreNotAskedFor) {
  const GroundTruth truth = some_truth();
  RunOutputs outputs = perfect_outputs(truth);
  auto& bottom = outputs.garments["bottom"];
  bottom.mesh = transformed(tube(0.21, 0.15, {0, 0, 0}, 0.5, 1.0, 64, 40, false), kModelFromWorld.matrix());
  const Scores scores = evaluate(outputs, truth, quick());
  EXPECT_NEAR(value(scores, "open", "bottom/rims_hd95_mm@1"), 0, 0.1);
  EXPECT_NEAR(value(scores, "open", "bottom/rim_waist_hd95_mm@1"), 200, 0.1);
}

TEST(Evaluate, FitFaultsShow) {
  const GroundTruth truth = some_truth();
  RunOutputs outputs = perfect_outputs(truth);
  outputs.garments["top"].fitted = transformed(top_mesh(), kModelFromWorld.matrix());
  for (auto& vertex : outputs.garments["top"].fitted.vertices) {
    const Vector3d world = kModelFromWorld.inverse() * vertex;
    vertex = kModelFromWorld * Vector3d(world.x() * 0.85, world.y(), world.z() * 0.8);
  }
  const Scores scores = evaluate(outputs, truth, quick());
  EXPECT_GT(value(scores, "correct", "top/intersecting_pairs@1"), 0);
  EXPECT_GT(value(scores, "correct", "top/penetration_max_mm@1"), 3);
  EXPECT_LT(value(scores, "fit", "top/ease_chest_change_mm@3"), -50);
  const double before = value(scores, "fit", "bottom/ease_hip_mm@3");
  EXPECT_NEAR(value(scores, "fit", "bottom/ease_hip_fitted_mm@3"), before * 1.1, 5)
      << "body and garment grew by a tenth";
  EXPECT_EQ(status(scores, "fit", "bottom/ease_chest_mm@3"), "absent");
}

TEST(Evaluate, GainIsTakenOutOfImages) {
  const GroundTruth truth = some_truth();
  RunOutputs outputs = perfect_outputs(truth);
  outputs.garments["top"].textured.texture = cv::Mat(truth.garments.at("top").textured.texture * 0.6);
  const Scores scores = evaluate(outputs, truth, quick());
  EXPECT_GT(value(scores, "texture", "top/ssim@2"), 0.93);
  EXPECT_LT(value(scores, "texture", "top/ssim_raw@2"), value(scores, "texture", "top/ssim@2") - 0.02);
  EXPECT_GT(value(scores, "texture", "top/gain_red@2"), 1.5);
  outputs.garments["top"].textured.texture = cv::Mat(64, 64, CV_8UC3, cv::Scalar(90, 90, 90));
  EXPECT_LT(value(evaluate(outputs, truth, quick()), "texture", "top/ssim@2"), 0.9) << "the print is gone";
}

TEST(Evaluate, ClothThatNobodySawCountsInOneSimilarityOnly) {
  GroundTruth truth = some_truth();
  RunOutputs outputs = perfect_outputs(truth);
  // The lower half is seen by no sensor, and the estimate knows nothing of its print.
  TruthGarment& top = truth.garments.at("top");
  double middle = 0;
  for (const auto& v : top.mesh.vertices) middle += v.y() / top.mesh.vertices.size();
  top.views.assign(top.mesh.vertices.size(), 1);
  for (std::size_t i = 0; i < top.views.size(); ++i) top.views[i] = top.mesh.vertices[i].y() > middle;
  TexturedMesh& estimate = outputs.garments["top"].textured;
  const cv::Scalar grey = cv::mean(estimate.texture);
  cv::Mat with_grey(estimate.texture.rows, 2 * estimate.texture.cols, estimate.texture.type(), grey);
  estimate.texture.copyTo(with_grey.colRange(0, estimate.texture.cols));
  for (std::size_t i = 0; i < estimate.mesh.triangles.size(); ++i) {
    double y = 0;
    for (int k = 0; k < 3; ++k) y += estimate.mesh.vertices[estimate.mesh.triangles[i][k]].y() / 3;
    for (auto& uv : estimate.corner_uv[i]) uv = y < middle ? Vector2f(0.75f, 0.5f) : Vector2f(uv.x() / 2, uv.y());
  }
  estimate.texture = with_grey;
  const Scores scores = evaluate(outputs, truth, quick());
  EXPECT_LT(value(scores, "texture", "top/ssim@2"), 0.97);
  EXPECT_GT(value(scores, "texture", "top/ssim_observed@2"), value(scores, "texture", "top/ssim@2") + 0.02);
}

TEST(HeldOutViews, WhatNoSensorSawIsUnobservedUpToItsOutline) {
  const TexturedMesh garment = some_truth().garments.at("top").textured;
  Renderer renderer;
  const std::vector<bool> nothing_seen(garment.mesh.triangles.size(), true);
  const HeldOutViews views = held_out_views(renderer, garment, garment, Vector3d(0, 1, 0), nothing_seen);
  for (std::size_t i = 0; i < views.truth_masks.size(); ++i) {
    EXPECT_GT(cv::countNonZero(views.truth_masks[i]), 1000);
    EXPECT_EQ(cv::countNonZero((views.truth_masks[i] > 0) != (views.unobserved_masks[i] > 0)), 0) << "view " << i;
  }
}

TEST(Evaluate, EveryRowIsThereWhateverIsMissing) {
  const GroundTruth truth = some_truth();
  std::set<std::pair<std::string, std::string>> all;
  for (const auto& row : evaluate(perfect_outputs(truth), truth, quick()).rows) all.insert({row.stage, row.metric});
  const Scores nothing = evaluate(RunOutputs{}, truth, quick());
  std::set<std::pair<std::string, std::string>> found;
  for (const auto& row : nothing.rows) {
    found.insert({row.stage, row.metric});
    if (row.metric == "unexpected_garments@1") continue;
    EXPECT_NE(row.status, "ok") << row.stage << " " << row.metric;
    EXPECT_TRUE(std::isnan(row.value)) << row.stage << " " << row.metric;
  }
  EXPECT_EQ(found, all);
  EXPECT_EQ(nothing.rows.size(), all.size()) << "no row twice";
}

TEST(Evaluate, EveryRowIsDeclared) {
  const GroundTruth truth = some_truth();
  for (const auto& row : evaluate(perfect_outputs(truth), truth, quick()).rows) {
    const Metric* metric = find_metric(row.stage, row.metric);
    ASSERT_NE(metric, nullptr) << row.stage << " " << row.metric;
    EXPECT_EQ(row.unit, metric->unit) << row.metric;
    EXPECT_EQ(metric->row_name(*metric->members_of(row.metric)), row.metric);
  }
}

TEST(Evaluate, AGaugeThatFailedFailsTheWorldButNotTheFit) {
  const GroundTruth truth = some_truth();
  RunOutputs outputs = perfect_outputs(truth);
  outputs.converged["k1"] = false;
  const Scores scores = evaluate(outputs, truth, quick());
  EXPECT_EQ(status(scores, "registration", "k2/tre_mm@1"), "failed");
  EXPECT_EQ(status(scores, "registration", "max/tre_mm@1"), "failed");
  EXPECT_EQ(status(scores, "surface", "top/f_5mm@1"), "failed");
  EXPECT_EQ(status(scores, "texture", "top/ssim@2"), "failed");
  EXPECT_EQ(status(scores, "correct", "top/intersecting_pairs@1"), "ok");
  EXPECT_EQ(status(scores, "open", "top/loops@1"), "ok");
}

TEST(Evaluate, SameOnAnyNumberOfThreads) {
  const GroundTruth truth = some_truth();
  const RunOutputs outputs = perfect_outputs(truth);
  const std::string many = scores_to_json(evaluate(outputs, truth, quick()));
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(scores_to_json(evaluate(outputs, truth, quick())), many);
}

TEST(Evaluate, AnotherGauge) {
  const GroundTruth truth = some_truth();
  EvaluateOptions options = quick();
  options.gauge_sensor = "k2";
  const Scores scores = evaluate(perfect_outputs(truth), truth, options);
  EXPECT_EQ(status(scores, "registration", "k1/tre_mm@1"), "ok");
  EXPECT_EQ(status(scores, "registration", "k2/tre_mm@1"), "no row");
  options.gauge_sensor = "k9";
  EXPECT_THROW(evaluate(perfect_outputs(truth), truth, options), InputError);
}

}  // namespace
}  // namespace dressform
