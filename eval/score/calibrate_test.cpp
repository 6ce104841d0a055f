#include "pipeline/calibrate/calibrate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "eval/metrics/calibration_metrics.h"
#include "eval/score/evaluate.h"
#include "synthetic/synthesize.h"

namespace dressform {
namespace {

Scene group1() { return read_scene(std::string(DRESSFORM_SOURCE_DIR) + "/scenes/library/group1.toml"); }

Calibration calibration_of(const Scene& scene) {
  Calibration calibration;
  for (const auto& sensor : scene.rig) calibration.sensors[sensor.name] = sensor.calibration;
  return calibration;
}

GroundTruth truth_of(const Scene& scene) {
  GroundTruth truth;
  for (const auto& sensor : scene.rig) truth.world_from_sensor[sensor.name] = sensor.world_from_sensor;
  truth.calibration = calibration_of(scene);
  return truth;
}

std::vector<ScoreRow> calibration_rows(const RunOutputs& outputs, const GroundTruth& truth) {
  EvaluateOptions options;
  options.images = false;
  std::vector<ScoreRow> rows;
  for (const auto& row : evaluate(outputs, truth, options).rows)
    if (row.stage == "calibrate") rows.push_back(row);
  return rows;
}

const ScoreRow& row_of(const std::vector<ScoreRow>& rows, const std::string& metric) {
  for (const auto& row : rows)
    if (row.metric == metric) return row;
  throw std::runtime_error("no row " + metric);
}

TEST(CalibrationScores, TruthIsPerfect) {
  const Scene scene = group1();
  RunOutputs outputs;
  outputs.calibration = calibration_of(scene);
  outputs.boards["k1"] = {0.1, 0.2};
  const auto rows = calibration_rows(outputs, truth_of(scene));
  EXPECT_EQ(rows.size(), 11u * 5);
  for (const auto& row : rows) {
    if (row.metric.find("reprojection") == std::string::npos) {
      EXPECT_EQ(row.status, "ok") << row.metric;
      EXPECT_LT(row.value, 1e-6) << row.metric;
    }
  }
  EXPECT_EQ(row_of(rows, "k1/color_reprojection_rms_px@1").value, 0.2);
  EXPECT_EQ(row_of(rows, "k2/color_reprojection_rms_px@1").status, "absent");
}

TEST(CalibrationScores, KnownErrorsAreMeasured) {
  const Scene scene = group1();
  RunOutputs outputs;
  outputs.calibration = calibration_of(scene);
  SensorCalibration& k2 = outputs.calibration->sensors.at("k2");
  k2.ir.fy *= 1.01;
  k2.color->cx += 3;
  k2.color->cy -= 4;
  k2.color_from_ir.prerotate(Eigen::AngleAxisd(0.2 * M_PI / 180, Vector3d::UnitY()));
  k2.depth_offset_m += 0.007;
  const auto rows = calibration_rows(outputs, truth_of(scene));
  EXPECT_NEAR(row_of(rows, "k2/ir_focal_error_percent@1").value, 1, 1e-9);
  EXPECT_NEAR(row_of(rows, "k2/color_principal_point_px@1").value, 5, 1e-9);
  EXPECT_NEAR(row_of(rows, "k2/color_from_ir_deg@1").value, 0.2, 1e-9);
  EXPECT_NEAR(row_of(rows, "max/depth_offset_mm@1").value, 7, 1e-9);
  EXPECT_GT(row_of(rows, "k2/point_mm@1").value, 7);
  EXPECT_GT(row_of(rows, "k2/mapping_px@1").value, 3);
}

TEST(CalibrationScores, AbsentWithoutTruthFailedWithoutEstimate) {
  GroundTruth truth = truth_of(group1());
  for (const auto& row : calibration_rows({}, truth)) EXPECT_EQ(row.status, "failed") << row.metric;
  truth.calibration.reset();
  RunOutputs outputs;
  outputs.calibration = calibration_of(group1());
  for (const auto& row : calibration_rows(outputs, truth)) EXPECT_EQ(row.status, "absent") << row.metric;
}

// The bounds that calibration from synthetic boards has to keep.
void expect_calibrated(const Scene& scene, Seed seed) {
  const SyntheticCapture capture = synthesize_boards(scene, seed);
  const Calibrated found = Calibrate::at("automatic").run(capture.session, {}, seed);
  for (const auto& sensor : scene.rig) {
    SCOPED_TRACE(sensor.name + ", seed " + std::to_string(seed));
    ASSERT_EQ(found.boards.count(sensor.name), 1u) << found.notes.at(sensor.name);
    const auto errors = metrics::sensor_errors(found.calibration.sensors.at(sensor.name),
                                               capture.truth.calibration->sensors.at(sensor.name));
    for (const auto& camera : {errors.ir, *errors.color}) {
      EXPECT_LE(camera.focal_percent, 0.2);
      EXPECT_LE(camera.principal_px, 2);
    }
    EXPECT_LE(errors.color_from_ir_deg, 0.05);
    EXPECT_LE(errors.color_from_ir_mm, 0.5);
    EXPECT_LE(errors.depth_offset_mm, 1);
    EXPECT_LE(found.boards.at(sensor.name).ir_rms_px, 0.3);
    EXPECT_LE(found.boards.at(sensor.name).color_rms_px, 0.4);
    std::printf(
        "%s seed %d: ir f %.4f %% c %.2f px, color f %.4f %% c %.2f px, color_from_ir %.4f deg %.3f mm, "
        "depth offset %.2f mm, rms %.3f and %.3f px\n",
        sensor.name.c_str(), int(seed), errors.ir.focal_percent, errors.ir.principal_px, errors.color->focal_percent,
        errors.color->principal_px, errors.color_from_ir_deg, errors.color_from_ir_mm, errors.depth_offset_mm,
        found.boards.at(sensor.name).ir_rms_px, found.boards.at(sensor.name).color_rms_px);
    std::fflush(stdout);
  }
}

// The session's own calibration is far off: what is found can only come from the boards.
Scene scene_with_boards(int sensors, int views) {
  Scene scene = group1();
  scene.rig.resize(sensors);
  scene.boards.emplace();
  scene.boards->views = views;
  scene.sensor_model = {"fankhauser", {}};
  scene.given_calibration = {2, 8, 0.5, 4, 10, false};
  const double offsets_m[] = {-0.015, 0.008, 0.020, -0.004};
  for (int i = 0; i < sensors; ++i) scene.rig[i].calibration.depth_offset_m = offsets_m[i];
  return scene;
}

TEST(CalibrationFromBoards, OneSensorTwelveBoards) { expect_calibrated(scene_with_boards(1, 12), 1); }

// Minutes for each seed: eval_test --gtest_also_run_disabled_tests --gtest_filter=*FourSensorsFiveSeeds*
class CalibrationOverSeeds : public testing::TestWithParam<int> {};

TEST_P(CalibrationOverSeeds, DISABLED_FourSensorsFiveSeeds) {
  expect_calibrated(scene_with_boards(4, 25), Seed(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Seeds, CalibrationOverSeeds, testing::Range(1, 6));

}  // namespace
}  // namespace dressform
