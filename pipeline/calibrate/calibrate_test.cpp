#include "pipeline/calibrate/calibrate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "pipeline/calibrate/board_square.h"
#include "pipeline/calibrate/from_boards.h"
#include "pipeline/calibrate/projection.h"
#include "pipeline/imaging/color_mapping.h"
#include "pipeline/imaging/depth_map.h"
#include "pipeline/testing/board_images.h"
#include "scenes/error.h"
#include "scenes/serialize.h"

namespace dressform {
namespace {

using board_images::grid;
using board_images::pose;
using testing::HasSubstr;

CaptureSession session_with(Boards boards) {
  CaptureSession session;
  session.sensors = {"k1"};
  session.boards = std::move(boards);
  return session;
}

// Ten good boards, drawn once.
const Boards& good_boards() {
  static const Boards boards =
      board_images::boards(board_images::sensor(), board_images::varied_poses(board_images::sensor()));
  return boards;
}

const SensorBoards& found_boards() {
  static const SensorBoards boards = find_boards(good_boards(), "k1");
  return boards;
}

Calibrated run(const CaptureSession& session, const std::string& variant = "bundle") {
  return Calibrate::at(variant).run(session, {}, 1);
}

std::string error_of(const CaptureSession& session, const std::string& variant = "bundle") {
  try {
    run(session, variant);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

double angle_deg(const Isometry3d& a, const Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear() * b.linear().transpose()).angle() * 180 / M_PI;
}

void expect_near_truth(const SensorCalibration& found, double loose = 1) {
  const SensorCalibration truth = board_images::sensor();
  EXPECT_NEAR(found.ir.fx / truth.ir.fx, 1, 0.002 * loose);
  EXPECT_NEAR(found.ir.fy / truth.ir.fy, 1, 0.002 * loose);
  EXPECT_NEAR(found.color->fx / truth.color->fx, 1, 0.002 * loose);
  EXPECT_NEAR(found.color->fy / truth.color->fy, 1, 0.002 * loose);
  EXPECT_LT(std::hypot(found.ir.cx - truth.ir.cx, found.ir.cy - truth.ir.cy), 2 * loose);
  EXPECT_LT(std::hypot(found.color->cx - truth.color->cx, found.color->cy - truth.color->cy), 2 * loose);
  EXPECT_LT(angle_deg(found.color_from_ir, truth.color_from_ir), 0.05 * loose);
  EXPECT_LT((found.color_from_ir.translation() - truth.color_from_ir.translation()).norm(), 0.0005 * loose);
  EXPECT_NEAR(found.depth_offset_m, truth.depth_offset_m, 0.001 * loose);
}

SensorBoards with_square(double times) {
  SensorBoards boards = found_boards();
  boards.grid.square_m *= times;
  return boards;
}

// Squares that are said to be larger or smaller than they are: depth speaks against it.
TEST(Calibrate, ASquareOfTheWrongSize) {
  for (const auto& [times, unit] : {std::pair(10.0, "a decimal place"),
                                    {100.0, "centimetres"},
                                    {1 / 0.0254, "inches"},
                                    {0.5, "two squares"},
                                    {1.2, ""}}) {
    try {
      fit_sensor(with_square(times), {}, by_bundle, nullptr);
      ADD_FAILURE() << "a square " << times << " times too large was taken";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("session.json: boards.square_m: found squares of")) << times;
      EXPECT_THAT(error.what(), HasSubstr(unit)) << times;
    }
  }
  EXPECT_NEAR(square_evidence(with_square(10)).depth_ratio * 10, 1, 0.03);
  EXPECT_NEAR(square_evidence(found_boards()).depth_ratio, 1, 0.03);
}

TEST(Calibrate, BoardsWithoutDepthSaySo) {
  SensorBoards boards = found_boards();
  for (auto& view : boards.views) view.depth.clear();
  const SensorFit fit = fit_sensor(boards, {}, by_bundle, nullptr);
  EXPECT_THAT(fit.note,
              HasSubstr("no depth on the boards in any of 10 shots: the depth offset is not known, 0 is taken"));
  EXPECT_EQ(fit.report.depth_views, 0);
  EXPECT_EQ(fit_sensor(found_boards(), {}, by_bundle, nullptr).note, "");
}

TEST(Calibrate, BundleFindsTheKnownSensor) {
  const Calibrated found = run(session_with(good_boards()));
  expect_near_truth(found.calibration.sensors.at("k1"));
  const BoardReport& report = found.boards.at("k1");
  EXPECT_EQ(report.shots, 10);
  EXPECT_EQ(report.found_ir, 10);
  EXPECT_EQ(report.found_color, 10);
  EXPECT_LT(report.ir_rms_px, 0.1);
  EXPECT_LT(report.color_rms_px, 0.1);
  EXPECT_LT(report.depth_rms_mm, 0.5);
  EXPECT_TRUE(report.converged);
}

// They estimate one thing after the other: ten small boards fix it less well than the bundle does.
TEST(Calibrate, SbDistortionAndDepthPlaneFindTheKnownSensor) {
  expect_near_truth(fit_sensor(found_boards(), {}, by_depth_plane, nullptr).sensor, 8);
  expect_near_truth(fit_sensor(found_boards(), {}, by_sb_distortion, nullptr).sensor, 8);
  expect_near_truth(run(session_with(good_boards()), "automatic").calibration.sensors.at("k1"));
}

// The thesis knows no distortion: right on a sensor that has none, and its residual tells where there is some.
TEST(Calibrate, ThesisIsRightWithoutDistortionOnly) {
  SensorCalibration straight = board_images::sensor();
  straight.ir.distortion = straight.color->distortion = {0, 0, 0, 0, 0};
  straight.depth_offset_m = 0;
  const auto found = run(session_with(board_images::boards(straight, board_images::varied_poses(straight))), "thesis");
  EXPECT_NEAR(found.calibration.sensors.at("k1").ir.fx / straight.ir.fx, 1, 0.003);
  EXPECT_LT(found.boards.at("k1").ir_rms_px, 0.1);
  const SensorFit bent = fit_sensor(found_boards(), {}, by_thesis, nullptr);
  EXPECT_GT(bent.report.ir_rms_px, 0.2);
  EXPECT_EQ(bent.sensor.ir.distortion, (std::array<double, 5>{0, 0, 0, 0, 0}));
}

// Depth of the boards with the offset found is their true depth, by both ways in which later stages read depth.
TEST(Calibrate, TheOffsetIsTakenOffByWhatReadsDepth) {
  const SensorCalibration found = fit_sensor(found_boards(), {}, by_bundle, nullptr).sensor;
  const SensorCalibration truth = board_images::sensor();
  const auto true_m =
      board_images::image(truth.ir, board_images::varied_poses(truth)[0], grid()).depth_m.at<float>(212, 256);
  const cv::Mat& measured = good_boards().shots.at("k1")[0].depth_mm;
  EXPECT_NEAR(measured.at<std::uint16_t>(212, 256) / 1000.0, true_m + truth.depth_offset_m, 0.001);
  EXPECT_NEAR(corrected_depth_mm(measured, found).at<float>(212, 256) / 1000, true_m, 0.0015);
  EXPECT_NEAR(clean_depth(measured, found, {}).at<float>(212, 256), true_m, 0.0015);
}

TEST(Calibrate, SameBytesForAnyThreadCount) {
  Boards few = good_boards();
  few.shots["k1"].resize(3);
  std::string bytes[2];
  for (int threads = 1; threads <= 2; ++threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    bytes[threads - 1] = to_bytes(run(session_with(few)));
  }
  EXPECT_EQ(bytes[0], bytes[1]);
}

TEST(Calibrate, TurnedCornersArePutRight) {
  SensorBoards boards = found_boards();
  const auto as_found = boards.views[3].color;
  std::reverse(boards.views[3].color.begin(), boards.views[3].color.end());
  std::reverse(boards.views[7].color.begin(), boards.views[7].color.end());
  boards.turned = 0;
  match_corner_order(boards);
  EXPECT_EQ(boards.turned, 2);
  EXPECT_EQ(boards.views[3].color, as_found);
}

TEST(Calibrate, MirroredColourIsAnInputError) {
  Boards boards = board_images::copy_of(good_boards());
  boards.shots["k1"].resize(4);
  for (auto& shot : boards.shots["k1"]) {
    cv::Mat mirrored;
    cv::flip(shot.color, mirrored, 1);
    shot.color = mirrored;
  }
  EXPECT_THAT(error_of(session_with(boards)), HasSubstr("mirrored against each other (left and right)"));
}

TEST(Calibrate, MirroredDepthIsAnInputError) {
  Boards boards = board_images::copy_of(good_boards());
  boards.shots["k1"].resize(4);
  for (auto& shot : boards.shots["k1"]) {
    cv::Mat mirrored;
    cv::flip(shot.depth_mm, mirrored, 1);
    shot.depth_mm = cv::max(mirrored, 400);  // a wall far before the boards
  }
  EXPECT_THAT(error_of(session_with(boards)), HasSubstr("mm off the board"));
}

TEST(Calibrate, BlurredCutOffAndOneSidedBoardsAreSurvived) {
  Boards boards = board_images::copy_of(good_boards());
  auto& shots = boards.shots["k1"];
  cv::GaussianBlur(shots[1].color.clone(), shots[1].color, {}, 6);
  cv::GaussianBlur(shots[2].ir.clone(), shots[2].ir, {}, 5);
  shots[4].ir.colRange(330, 512).setTo(0);
  shots[6].color.setTo(90);
  const Calibrated found = run(session_with(boards));
  expect_near_truth(found.calibration.sensors.at("k1"));
  const BoardReport& report = found.boards.at("k1");
  EXPECT_LE(report.used_ir, 9);
  EXPECT_LE(report.used_color, 9);
  EXPECT_GE(report.used_ir, 6);
  EXPECT_LE(report.found_color, 9);
}

TEST(Calibrate, ThreeFrontalBoardsDoNotFixTheFocalLength) {
  const SensorCalibration s = board_images::sensor();
  CaptureSession session = session_with(
      board_images::boards(s, {pose(s, grid(), 200, 200, 1.0, 0, 0, 0), pose(s, grid(), 300, 220, 1.02, 0, 0, 5),
                               pose(s, grid(), 250, 212, 1.01, 1, 0, 90)}));
  const Calibrated alone = run(session);
  EXPECT_NEAR(alone.calibration.sensors.at("k1").ir.fx / s.ir.fx, 1, 0.05);
  EXPECT_FALSE(alone.boards.at("k1").converged);
  session.calibration = Calibration{{{"k1", s}}};
  const Calibrated kept = run(session, "automatic");
  EXPECT_EQ(kept.calibration.sensors.at("k1").ir.fx, s.ir.fx);
  EXPECT_EQ(kept.boards.count("k1"), 0u);
  EXPECT_THAT(kept.notes.at("k1"), HasSubstr("calibration.json kept"));
}

TEST(Calibrate, ThreeGoodBoardsAreEnough) {
  const SensorCalibration s = board_images::sensor();
  const auto poses = board_images::varied_poses(s);
  const Calibrated found = run(session_with(board_images::boards(s, {poses[1], poses[4], poses[9]})));
  expect_near_truth(found.calibration.sensors.at("k1"), 8);
}

TEST(Calibrate, WithoutDepthTheOffsetIsTheSessions) {
  SensorBoards boards = found_boards();
  for (auto& view : boards.views) view.depth.clear();
  EXPECT_EQ(fit_sensor(boards, {}, by_bundle, nullptr).sensor.depth_offset_m, 0);
  const SensorCalibration given = board_images::sensor();
  const SensorFit found = fit_sensor(boards, {}, by_bundle, &given);
  EXPECT_EQ(found.report.depth_views, 0);
  expect_near_truth(found.sensor, 2);
  EXPECT_EQ(found.sensor.depth_offset_m, -0.014);
}

TEST(Calibrate, NoBoardFoundSaysWhatWasExpected) {
  Boards boards = board_images::copy_of(good_boards());
  boards.shots["k1"].resize(3);
  for (auto& shot : boards.shots["k1"]) shot.ir.setTo(1000);
  for (const char* variant : {"bundle", "automatic"})
    EXPECT_THAT(error_of(session_with(boards), variant),
                AllOf(HasSubstr("boards/k1"), HasSubstr("expected at least 3"),
                      HasSubstr("board of 7 x 5 inner corners in 0 infrared and 3 colour images of 3 shots")));
  CaptureSession none;
  none.sensors = {"k1"};
  EXPECT_THAT(error_of(none), HasSubstr("session.json: boards"));
  EXPECT_THAT(error_of(none, "automatic"), HasSubstr("neither a calibration nor boards"));
}

TEST(Calibrate, OtherSignOfTheStepIsNoted) {
  SensorCalibration other = board_images::sensor();
  other.color_from_ir.translation().x() *= -1;
  EXPECT_THAT(fit_sensor(found_boards(), {}, by_bundle, &other).note, HasSubstr("mirrored"));
  const SensorCalibration same = board_images::sensor();
  EXPECT_EQ(fit_sensor(found_boards(), {}, by_bundle, &same).note, "");
}

TEST(Calibrate, WithoutBoardsTheSessionsCalibrationPasses) {
  CaptureSession session;
  session.sensors = {"k1"};
  session.calibration = Calibration{{{"k1", board_images::sensor()}, {"handheld", board_images::sensor()}}};
  for (const char* variant : {"automatic", "from_session"})
    EXPECT_EQ(to_bytes(run(session, variant).calibration), to_bytes(*session.calibration));
}

TEST(Projection, DerivativesAreThoseOfDifferences) {
  const Camera camera = board_images::sensor().ir;
  const Vector2d ideal(0.31, -0.22);
  const Projection at = project_ideal(camera, ideal);
  EXPECT_LT((at.pixel - camera.project(Vector3d(0.31, -0.22, 1))).norm(), 1e-9);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 2; ++i) {
    Vector2d step = Vector2d::Zero();
    step[i] = kStep;
    const Vector2d slope =
        (project_ideal(camera, ideal + step).pixel - project_ideal(camera, ideal - step).pixel) / (2 * kStep);
    EXPECT_LT((slope - at.by_ideal.col(i)).norm(), 1e-4);
  }
  for (int i = 0; i < 9; ++i) {
    Vector9d step = Vector9d::Zero();
    step[i] = kStep;
    const Camera more = camera_with(camera, camera_vector(camera) + step);
    const Camera less = camera_with(camera, camera_vector(camera) - step);
    const Vector2d slope = (project_ideal(more, ideal).pixel - project_ideal(less, ideal).pixel) / (2 * kStep);
    EXPECT_LT((slope - at.by_camera.col(i)).norm(), 1e-4);
  }
}

}  // namespace
}  // namespace dressform
