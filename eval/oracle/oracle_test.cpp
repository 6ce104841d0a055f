#include "eval/oracle/oracle.h"

#include <gtest/gtest.h>

#include "eval/oracle/oracle_frames.h"
#include "scenes/error.h"
#include "scenes/serialize.h"

namespace dressform {
namespace {

Isometry3d motion(double angle, const Vector3d& axis, const Vector3d& shift) {
  Isometry3d result = Isometry3d::Identity();
  result.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  result.translation() = shift;
  return result;
}

template <class T>
LazyArtifact<T> held(const T& value) {
  return {"test", [value] { return value; }};
}

// A run of which the naked model and one sensor's pose are known.
Reconstruction run_with(const BodyModel& naked, const Registration& registration) {
  return {{"k1", "k2"},
          held(Calibrated{}),
          held(Calibration{}),
          held(Multipath{}),
          held(naked),
          held(ExtractedViews{}),
          held(registration),
          held(Landmarks{}),
          held(Segmentation{}),
          held(FilledViews{}),
          held(ClosedGarments{}),
          held(OpenGarments{}),
          held(TexturedGarments{}),
          {},
          {},
          {},
          {},
          {}};
}

const Isometry3d kModelFromWorld = motion(0.7, {0.1, 1, 0}, {0.3, 0.02, -0.4});

GroundTruth truth_of_two_sensors() {
  GroundTruth truth;
  truth.world_from_sensor = {{"k1", motion(0.2, {0, 1, 0}, {0, 1, 2})}, {"k2", motion(2.2, {1, 1, 0}, {2, 1, 0})}};
  truth.naked_body.vertices = {{0, 0, 0}, {0.2, 1.8, 0.1}, {-0.2, 0.9, 0}};
  truth.naked_body.triangles = {{0, 1, 2}};
  for (int i = 0; i < 12; ++i)
    truth.scan_world_from_sensor["scan_naked"].push_back(motion(0.5 * i, {0, 1, 0}, {std::sin(0.5 * i), 1, 0}));
  return truth;
}

// Tracked with an error that is the same both ways, and one lost frame.
BodyModel tracked(const GroundTruth& truth) {
  BodyModel model;
  for (std::size_t i = 0; i < truth.scan_world_from_sensor.at("scan_naked").size(); ++i) {
    const Isometry3d drift = motion(i % 2 ? 0.01 : -0.01, {0, 1, 0}, Vector3d::Zero());
    model.model_from_frame.push_back(kModelFromWorld * drift * truth.scan_world_from_sensor.at("scan_naked")[i]);
  }
  model.model_from_frame.push_back(Isometry3d(Eigen::Matrix4d::Constant(std::nan(""))));
  model.body = truth.naked_body;
  return model;
}

TEST(Oracle, MeanOfMotionsIsTheirMiddle) {
  const Vector3d centre(0.3, 1, 0.2);
  const std::vector<Isometry3d> motions{motion(0.3, {0, 1, 0}, {1, 0, 0}), motion(0.5, {0, 1, 0}, {3, 0, 0})};
  const Isometry3d mean = mean_motion(motions, centre);
  EXPECT_NEAR(Eigen::AngleAxisd(mean.linear()).angle(), 0.4, 1e-12);
  EXPECT_NEAR((mean * centre - (motions[0] * centre + motions[1] * centre) / 2).norm(), 0, 1e-12);
}

TEST(Oracle, RegistrationPutsAllSensorsWhereTheyStood) {
  const GroundTruth truth = truth_of_two_sensors();
  const Reconstruction made = run_with(tracked(truth), {});
  GivenArtifacts given;
  give_truth("registration", {made, {}, truth}, given);
  const auto result = from_bytes<Registration>(*given.find("registration"));
  ASSERT_EQ(result.model_from_sensor.size(), 2u);
  for (const auto& [sensor, pose] : truth.world_from_sensor) {
    EXPECT_TRUE(result.converged.at(sensor));
    EXPECT_TRUE(result.model_from_sensor.at(sensor).isApprox(kModelFromWorld * pose, 1e-3)) << sensor;
  }
  const Isometry3d step = result.model_from_sensor.at("k1").inverse() * result.model_from_sensor.at("k2");
  EXPECT_TRUE(step.isApprox(truth.world_from_sensor.at("k1").inverse() * truth.world_from_sensor.at("k2"), 1e-12));
}

TEST(Oracle, TheTrueBodyStandsOnTheFloorAboutItsAxis) {
  GroundTruth truth = truth_of_two_sensors();
  for (auto& vertex : truth.naked_body.vertices) vertex += Vector3d(1, 0, 2);
  BodyModel model = tracked(truth);
  model.surroundings.points = {kModelFromWorld * Vector3d(3, 0, 3)};
  model.surroundings.normals = {kModelFromWorld.linear() * Vector3d::UnitY()};
  GivenArtifacts given;
  give_truth("fuse_naked", {run_with(model, {}), {}, truth}, given);
  const auto result = from_bytes<BodyModel>(*given.find("fuse_naked"));
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR(centroid_of(result.body).x(), 0, 1e-12);
  EXPECT_NEAR(result.body.vertices[0].y(), 0, 1e-12);
  ASSERT_EQ(result.model_from_frame.size(), 12u);
  EXPECT_NEAR(result.surroundings.points[0].y(), 0, 0.05);  // went along, as the tracking has it
  EXPECT_GT(result.surroundings.normals[0].y(), 0.999);
}

TEST(Oracle, OnlyWhatTruthHoldsHasOne) {
  const auto labels = oracle_labels();
  const std::vector<std::string> expected{"calibrate", "fuse_naked", "fuse_user", "extract", "registration",
                                          "segment",   "surface",    "open",      "texture"};
  EXPECT_EQ(labels, expected);
  const GroundTruth truth;
  const Reconstruction made = run_with({}, {});
  GivenArtifacts given;
  for (const auto& label : labels) EXPECT_THROW(give_truth(label, {made, {}, truth}, given), InputError) << label;
  EXPECT_THROW(check_oracle("study.toml:3:1", "fit"), InputError);
}

TEST(Oracle, GaugeIsTheFirstSensorWhereItIsRegistered) {
  const GroundTruth truth = truth_of_two_sensors();
  Registration registration;
  registration.model_from_sensor["k1"] = kModelFromWorld * truth.world_from_sensor.at("k1");
  registration.converged["k1"] = true;
  EXPECT_TRUE(model_from_world_by_gauge({run_with({}, registration), {}, truth}).isApprox(kModelFromWorld, 1e-12));
  registration.converged["k1"] = false;
  EXPECT_THROW(model_from_world_by_gauge({run_with({}, registration), {}, truth}), InputError);
}

}  // namespace
}  // namespace dressform
