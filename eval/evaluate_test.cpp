#include "eval/evaluate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <fstream>
#include <opencv2/core.hpp>
#include <set>

#include "eval/held_out.h"
#include "eval/metrics/test_meshes.h"
#include "scenes/error.h"
#include "scenes/json_file.h"
#include "scenes/mesh_io.h"
#include "scenes/random.h"

namespace dressform {
namespace {

using namespace test_meshes;
namespace fs = std::filesystem;

TexturedMesh textured(const Mesh& mesh, int seed) {
  TexturedMesh result{mesh, {}, cv::Mat(64, 64, CV_8UC3)};
  cv::RNG generator(seed);
  cv::Mat coarse(32, 32, CV_8UC3);
  generator.fill(coarse, cv::RNG::UNIFORM, 30, 200);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) result.texture.at<cv::Vec3b>(y, x) = coarse.at<cv::Vec3b>(y / 2, x / 2);
  for (const auto& t : mesh.triangles) {
    std::array<Vector2f, 3> corners;
    for (int k = 0; k < 3; ++k) {
      const Vector3d& v = mesh.vertices[t[k]];
      corners[k] = {static_cast<float>(0.5 + v.x()), static_cast<float>(0.5 - 0.4 * (v.y() - 1))};
    }
    result.corner_uv.push_back(corners);
  }
  return result;
}

std::vector<Vector3d> ring(double radius_x, double radius_z, double y) {
  std::vector<Vector3d> points;
  for (int j = 0; j < 64; ++j)
    points.push_back({radius_x * std::sin(2 * M_PI * j / 64), y, radius_z * std::cos(2 * M_PI * j / 64)});
  return points;
}

TruthGarment garment(const Mesh& mesh, int seed) {
  return {mesh, std::vector<std::uint8_t>(mesh.vertices.size(), 2), textured(mesh, seed), {}};
}

Mesh bottom_mesh() { return tube(0.21, 0.15, {0, 0, 0}, 0.5, 1.2, 64, 40, false); }
Mesh top_mesh() { return tube(0.22, 0.16, {0, 0, 0}, 1.0, 1.45, 64, 30, false); }

GroundTruth some_truth() {
  GroundTruth truth;
  for (int i = 0; i < 4; ++i) {
    Isometry3d pose = Isometry3d::Identity();
    const double azimuth = i * M_PI / 2;
    pose.linear().col(2) = -Vector3d(std::sin(azimuth), 0, std::cos(azimuth));
    pose.linear().col(1) = -Vector3d::UnitY();
    pose.linear().col(0) = pose.linear().col(1).cross(pose.linear().col(2));
    pose.translation() = -2.1 * pose.linear().col(2) + Vector3d(0, 1.25, 0);
    truth.world_from_sensor["k" + std::to_string(i + 1)] = pose;
  }
  truth.scan_world_from_sensor["scan_user"] = {truth.world_from_sensor.at("k2")};
  truth.naked_body = figure();
  truth.user_body = figure(1.1);
  truth.garments["top"] = garment(top_mesh(), 1);
  truth.garments["bottom"] = garment(bottom_mesh(), 2);
  truth.rims["top"] = {{"neck", 1, ring(0.22, 0.16, 1.45)}, {"hem", 1, ring(0.22, 0.16, 1.0)}};
  truth.rims["bottom"] = {{"waist", 0.1, ring(0.21, 0.15, 1.2)}, {"hem", 1, ring(0.21, 0.15, 0.5)}};
  cv::Mat label(90, 160, CV_8UC1, cv::Scalar(0));
  label(cv::Rect(60, 10, 40, 70)) = 1;
  label(cv::Rect(60, 20, 40, 30)) = 2;
  label(cv::Rect(60, 50, 40, 20)) = 3;
  for (const auto& [sensor, pose] : truth.world_from_sensor) truth.labels[sensor] = label;
  return truth;
}

const Isometry3d kModelFromWorld = Eigen::Translation3d(0.3, 0, -0.2) * Eigen::AngleAxisd(0.8, Vector3d::UnitY());

// What a flawless run would hand out, in a model frame of its own.
RunOutputs perfect_outputs(const GroundTruth& truth) {
  RunOutputs outputs;
  for (const auto& [sensor, pose] : truth.world_from_sensor) {
    outputs.model_from_sensor[sensor] = kModelFromWorld * pose;
    outputs.converged[sensor] = true;
  }
  outputs.user_model_from_frame0 = kModelFromWorld * truth.scan_world_from_sensor.at("scan_user").front();
  outputs.naked_body = transformed(truth.naked_body, kModelFromWorld.matrix());
  outputs.user_body = transformed(truth.user_body, kModelFromWorld.matrix());
  for (const auto& [slot, garment] : truth.garments) {
    auto& output = outputs.garments[slot];
    output.mesh = transformed(garment.mesh, kModelFromWorld.matrix());
    output.textured = garment.textured;
    output.textured.mesh = output.mesh;
    Mesh fitted = garment.mesh;
    for (auto& vertex : fitted.vertices) vertex = Vector3d(vertex.x() * 1.1, vertex.y(), vertex.z() * 1.1);
    output.fitted = transformed(fitted, kModelFromWorld.matrix());
  }
  outputs.labels = truth.labels;
  return outputs;
}

EvaluateOptions quick() {
  EvaluateOptions options;
  options.sample_spacing_m = 0.005;
  return options;
}

double value(const Scores& scores, const std::string& stage, const std::string& metric) {
  const auto* row = scores.find(stage, metric);
  EXPECT_NE(row, nullptr) << stage << " " << metric;
  EXPECT_EQ(row ? row->status : "no row", "ok") << stage << " " << metric;
  return row ? row->value : NAN;
}
std::string status(const Scores& scores, const std::string& stage, const std::string& metric) {
  const auto* row = scores.find(stage, metric);
  return row ? row->status : "no row";
}

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

TEST(RunOutputs, ReadFromARunFolder) {
  const fs::path run = fs::path(testing::TempDir()) / "run_outputs_test";
  fs::remove_all(run);
  fs::create_directories(run / "out");
  fs::create_directories(run / "stages/06_segment");
  EXPECT_THROW(read_run_outputs(run), InputError);
  const RunOutputs written = perfect_outputs(some_truth());
  nlohmann::ordered_json poses, converged;
  for (const auto& [sensor, pose] : written.model_from_sensor) poses[sensor] = to_json(pose);
  for (const auto& [sensor, flag] : written.converged) converged[sensor] = flag;
  write_json(run / "out/registration.json", {{"model_from_sensor", poses}, {"converged", converged}});
  EXPECT_TRUE(read_run_outputs(run).garments.empty());
  write_ply(run / "out/naked_body.ply", written.naked_body);
  write_ply(run / "out/top.ply", written.garments.at("top").mesh);
  write_ply(run / "out/top_fitted.ply", written.garments.at("top").fitted);
  write_glb(run / "out/top.glb", written.garments.at("top").textured);
  const RunOutputs read = read_run_outputs(run);
  EXPECT_EQ(read.naked_body.vertices, written.naked_body.vertices);
  EXPECT_EQ(read.garments.size(), 1u);
  EXPECT_EQ(read.garments.at("top").mesh.triangles, written.garments.at("top").mesh.triangles);
  EXPECT_EQ(read.garments.at("top").fitted.vertices, written.garments.at("top").fitted.vertices);
  EXPECT_EQ(read.garments.at("top").textured.texture.size(), cv::Size(64, 64));
  EXPECT_FALSE(read.user_model_from_frame0);
  EXPECT_TRUE(read.converged.at("k1"));
  std::ofstream(run / "out/top.ply") << "ply\n";
  EXPECT_THROW(read_run_outputs(run), InputError);
  fs::remove_all(run);
}

}  // namespace
}  // namespace dressform
