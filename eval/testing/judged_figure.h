#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <string>

#include "eval/score/evaluate.h"
#include "eval/testing/test_meshes.h"

// A standing figure of tubes in two garments: its truth, and what a flawless run would hand out.
namespace dressform::judged_figure {

using namespace test_meshes;

inline TexturedMesh textured(const Mesh& mesh, int seed) {
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

inline std::vector<Vector3d> ring(double radius_x, double radius_z, double y) {
  std::vector<Vector3d> points;
  for (int j = 0; j < 64; ++j)
    points.push_back({radius_x * std::sin(2 * M_PI * j / 64), y, radius_z * std::cos(2 * M_PI * j / 64)});
  return points;
}

inline TruthGarment garment(const Mesh& mesh, int seed) {
  return {mesh, std::vector<std::uint8_t>(mesh.vertices.size(), 2), textured(mesh, seed), {}};
}

inline Mesh bottom_mesh() { return tube(0.21, 0.15, {0, 0, 0}, 0.5, 1.2, 64, 40, false); }
inline Mesh top_mesh() { return tube(0.22, 0.16, {0, 0, 0}, 1.0, 1.45, 64, 30, false); }

inline GroundTruth some_truth() {
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

inline const Isometry3d kModelFromWorld =
    Eigen::Translation3d(0.3, 0, -0.2) * Eigen::AngleAxisd(0.8, Vector3d::UnitY());

// What a flawless run would hand out, in a model frame of its own.
inline RunOutputs perfect_outputs(const GroundTruth& truth) {
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

inline EvaluateOptions quick() {
  EvaluateOptions options;
  options.sample_spacing_m = 0.005;
  return options;
}

inline double value(const Scores& scores, const std::string& stage, const std::string& metric) {
  const auto* row = scores.find(stage, metric);
  EXPECT_NE(row, nullptr) << stage << " " << metric;
  EXPECT_EQ(row ? row->status : "no row", "ok") << stage << " " << metric;
  return row ? row->value : NAN;
}
inline std::string status(const Scores& scores, const std::string& stage, const std::string& metric) {
  const auto* row = scores.find(stage, metric);
  return row ? row->status : "no row";
}

}  // namespace dressform::judged_figure
