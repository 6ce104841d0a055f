#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "scenes/import/import_fixture.h"
#include "scenes/scene_fields.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

const cv::Size kIr(64, 53), kColor(96, 54);

std::string yaml_matrix(const std::string& name, int rows, int columns, const std::string& numbers) {
  return name + ": !!opencv-matrix\n   rows: " + std::to_string(rows) + "\n   cols: " + std::to_string(columns) +
         "\n   dt: d\n   data: [ " + numbers + " ]\n";
}
std::string yaml_camera(const std::string& matrix, const std::string& distortion, int coefficients = 5) {
  return "%YAML:1.0\n" + yaml_matrix("cameraMatrix", 3, 3, matrix) +
         yaml_matrix("distortionCoefficients", 1, coefficients, distortion);
}

class ImportKinect2 : public Import {
 protected:
  void SetUp() override {
    Import::SetUp();
    for (int i : {0, 3, 12}) shot(i);
  }
  static std::string number(int i) {
    char text[16];
    std::snprintf(text, sizeof text, "%04d", i);
    return text;
  }
  void shot(int i, const std::string& sync = "_sync") const {
    image(number(i) + sync + "_color.png", cv::Mat(kColor, CV_8UC1, cv::Scalar(40 + i)));
    image(number(i) + sync + "_ir.png", ramp(kIr, 100 * i, 1));
    image(number(i) + sync + "_depth.png", ramp(kIr, 1000 + i, 0));
    image(number(i) + sync + "_grey_ir.png", cv::Mat(kIr, CV_8UC1, cv::Scalar(3)));
    write(number(i) + sync + "_ir_points.yaml", "%YAML:1.0\n");
  }
  void calibrate() const {
    write("calib_color.yaml",
          yaml_camera("53.5, 0., 47.25, 0., 53.25, 26.5, 0., 0., 1.", "0.05, -0.06, 1e-3, -2e-3, 0.02"));
    write("calib_ir.yaml", yaml_camera("45.5, 0., 31.5, 0., 45.25, 26.25, 0., 0., 1.", "0.09, -0.27, 0., 0., 0.1"));
    write("calib_pose.yaml", "%YAML:1.0\n" + yaml_matrix("rotation", 3, 3, "1, 0, 0, 0, 0, -1, 0, 1, 0") +
                                 yaml_matrix("translation", 3, 1, "-0.052, 0.001, -0.002"));
    write("calib_depth.yaml", "%YAML:1.0\ndepthShift: 25.5\n");
  }
};

TEST_F(ImportKinect2, BoardsWithoutCalibration) {
  recording_ += "/";
  const CaptureSession session = imported(of("iai_kinect2"));
  EXPECT_EQ(session.name, "recording");
  EXPECT_FALSE(session.calibration);
  EXPECT_THAT(session.sensors, ElementsAre("k1"));
  ASSERT_TRUE(session.boards);
  EXPECT_EQ(session.boards->inner_corners_x, 5);
  EXPECT_EQ(session.boards->inner_corners_y, 7);
  EXPECT_EQ(session.boards->square_m, 0.03);
  const auto& shots = session.boards->shots.at("k1");
  ASSERT_EQ(shots.size(), 3u);
  EXPECT_EQ(shots[1].color.at<cv::Vec3b>(5, 5), cv::Vec3b(43, 43, 43));  // grey becomes colour
  EXPECT_EQ(cv::norm(shots[2].ir, ramp(kIr, 1200, 1), cv::NORM_INF), 0);
  EXPECT_EQ(shots[2].depth_mm.at<std::uint16_t>(3, 3), 1012);
}

TEST_F(ImportKinect2, AShotWithItsCalibration) {
  calibrate();
  ImportRequest request = of("iai_kinect2", "dressed");
  request.first = 1;
  request.sensor = "left";
  request.world_from_sensor = world_from_placed_sensor(SensorPlace{90, 2.1, 1.25, 0, 0, 0});
  const CaptureSession session = imported(request);
  EXPECT_THAT(session.sensors, ElementsAre("left"));
  EXPECT_EQ(session.dressed.at("left").depth_mm.at<std::uint16_t>(0, 0), 1003);
  const SensorCalibration& sensor = session.calibration->sensors.at("left");
  EXPECT_EQ(sensor.model, "kinect_v2");
  EXPECT_EQ(sensor.ir.width, kIr.width);
  EXPECT_EQ(sensor.ir.fx, 45.5);
  EXPECT_EQ(sensor.ir.cy, 26.25);
  EXPECT_EQ(sensor.ir.distortion[1], -0.27);
  EXPECT_EQ(sensor.color->height, kColor.height);
  EXPECT_EQ(sensor.color->fy, 53.25);
  EXPECT_EQ(sensor.color->distortion[4], 0.02);
  EXPECT_EQ(sensor.color_from_ir.translation(), Vector3d(-0.052, 0.001, -0.002));
  EXPECT_EQ(sensor.color_from_ir.linear() * Vector3d::UnitY(), Vector3d::UnitZ());
  EXPECT_DOUBLE_EQ(sensor.depth_offset_m, -0.0255);  // added to what is measured, it gives the truth
  EXPECT_NEAR((session.prior->world_from_sensor.at("left").translation() - Vector3d(2.1, 1.25, 0)).norm(), 0, 1e-12);
}

TEST_F(ImportKinect2, AScanNeedsDepthAlone) {
  calibrate();
  fs::remove(recording_ / "0003_sync_color.png");
  fs::remove(recording_ / "0012_sync_ir.png");
  const CaptureSession session = imported(of("iai_kinect2", "scan_user"));
  EXPECT_EQ(session.scans.at("scan_user").depth_mm.size(), 3u);
  EXPECT_EQ(session.calibration->sensors.at("handheld").ir.fx, 45.5);
}

TEST_F(ImportKinect2, ShotsNotTakenTogether) {
  shot(7, "");
  imported(of("iai_kinect2"));
  EXPECT_EQ(report_.frames, 3);
  EXPECT_THAT(report_.notes, testing::Contains(HasSubstr("1 shots left out")));
  fs::remove_all(session_);
  for (int i : {0, 3, 12})
    for (const char* what : {"color", "ir", "depth"}) fs::remove(recording_ / (number(i) + "_sync_" + what + ".png"));
  EXPECT_THAT(error(of("iai_kinect2")), HasSubstr("found colour and infrared of different moments only"));
  ImportRequest request = of("iai_kinect2");
  request.values["separate"] = std::string("true");
  EXPECT_EQ(imported(request).boards->shots.at("k1").size(), 1u);
}

TEST_F(ImportKinect2, WhatTheViewerSavesIsRectifiedAndShiftedAlready) {
  fs::remove_all(recording_);
  for (int i = 0; i < 2; ++i) {
    image(number(i) + "_depth.png", ramp(kIr, 900, 0));
    write(number(i) + "_color.jpg", "never opened");
    write(number(i) + "_depth_colored.png", "never opened");
  }
  calibrate();
  SensorCalibration sensor = imported(of("iai_kinect2", "scan_user")).calibration->sensors.at("handheld");
  EXPECT_EQ(sensor.ir.fx, 45.5);
  EXPECT_EQ(sensor.ir.distortion[0], 0);
  EXPECT_EQ(sensor.depth_offset_m, 0);
  fs::remove_all(session_);
  for (int i = 0; i < 2; ++i) image(number(i) + "_depth.png", ramp({96, 54}, 900, 0));  // 1920 x 1080 by 20
  write("calib_color.yaml", yaml_camera("1060, 0., 960, 0., 1058, 530, 0., 0., 1.", "0.05, -0.06, 0, 0, 0.02"));
  sensor = imported(of("iai_kinect2", "scan_user")).calibration->sensors.at("handheld");
  EXPECT_EQ(sensor.ir.width, 96);
  EXPECT_DOUBLE_EQ(sensor.ir.fx, 53);
  EXPECT_DOUBLE_EQ(sensor.ir.cy, 26.5);
  EXPECT_EQ(sensor.ir.distortion[0], 0);
}

// Directions land where OpenCV's rational model puts them, with the five coefficients that a session has.
TEST_F(ImportKinect2, ARationalLensBecomesThePolynomialNearestToIt) {
  calibrate();
  const std::array<double, 8> d{0.45, -0.32, 1e-3, -2e-3, 0.02, 0.36, -0.2, 0.05};  // k1 k2 p1 p2 k3 k4 k5 k6
  write("calib_ir.yaml", yaml_camera("45.5, 0., 31.5, 0., 45.25, 26.25, 0., 0., 1.",
                                     "0.45, -0.32, 1e-3, -2e-3, 0.02, 0.36, -0.2, 0.05", 8));
  const Camera found = imported(of("iai_kinect2", "naked")).calibration->sensors.at("k1").ir;
  EXPECT_THAT(report_.notes, testing::Contains(HasSubstr("calib_ir.yaml: eight coefficients of the lens became five")));
  for (const Vector2d& at : {Vector2d(0, 0), Vector2d(0.3, 0.2), Vector2d(-0.5, 0.3), Vector2d(0.4, -0.4)}) {
    const double s = at.squaredNorm();
    const double k = (1 + s * (d[0] + s * (d[1] + s * d[4]))) / (1 + s * (d[5] + s * (d[6] + s * d[7])));
    const Vector2d tangential(2 * d[2] * at.x() * at.y() + d[3] * (s + 2 * at.x() * at.x()),
                              d[2] * (s + 2 * at.y() * at.y()) + 2 * d[3] * at.x() * at.y());
    const Vector2d wanted = (k * at + tangential).cwiseProduct(Vector2d(45.5, 45.25)) + Vector2d(31.5, 26.25);
    EXPECT_LT((found.project(Vector3d(at.x(), at.y(), 1)) - wanted).norm(), 0.05) << at.transpose();
  }
}

TEST_F(ImportKinect2, ImageErrors) {
  fs::remove(recording_ / "0003_sync_ir.png");
  EXPECT_THAT(error(of("iai_kinect2")), HasSubstr("0003_sync_ir.png: is missing; expected color, ir and depth"));
  shot(3);
  image("0003_sync_ir.png", ramp({62, 53}, 0, 1));
  EXPECT_THAT(error(of("iai_kinect2")), HasSubstr("0003_sync_ir.png: found 62 x 53 pixels; expected 64 x 53"));
  image("0003_sync_ir.png", cv::Mat(kIr, CV_8UC1, cv::Scalar(9)));
  EXPECT_THAT(error(of("iai_kinect2")), HasSubstr("0003_sync_ir.png: found 8-bit grey; expected 16-bit grey"));
  shot(3);
  image("0012_sync_color.png", cv::Mat(kColor, CV_8UC4, cv::Scalar::all(7)));
  EXPECT_THAT(error(of("iai_kinect2")), HasSubstr("0012_sync_color.png: found 8-bit colour with transparency"));
  fs::remove_all(recording_);
  EXPECT_THAT(error(of("iai_kinect2")), HasSubstr("recording: is missing"));
  fs::create_directories(recording_);
  EXPECT_THAT(error(of("iai_kinect2")), HasSubstr("recording: found no recorded images"));
}

TEST_F(ImportKinect2, CalibrationErrors) {
  const ImportRequest request = of("iai_kinect2", "naked");
  EXPECT_THAT(error(request), HasSubstr("0000_sync_depth.png: found no calibration for 64 x 53 pixels; expected "
                                        "calib_ir.yaml, calib_color.yaml and calib_pose.yaml"));
  calibrate();
  fs::remove(recording_ / "calib_pose.yaml");
  EXPECT_THAT(error(request), HasSubstr("calib_pose.yaml: found no such file"));
  calibrate();
  write("calib_ir.yaml", "%YAML:1.0\n" + yaml_matrix("cameraMatrix", 3, 3, "45, 0, 31, 0, 44, 26, 0, 0, 1"));
  EXPECT_THAT(error(request), HasSubstr("calib_ir.yaml: distortionCoefficients: is missing"));
  write("calib_ir.yaml", yaml_camera("45, 0, 31, 0, 44, 26, 0, 0, 1", "0, 0, 0, 0, 0, 0, 0, 0, 0.1, 0, 0, 0", 12));
  EXPECT_THAT(error(request), HasSubstr("calib_ir.yaml: distortionCoefficients: found 12 coefficients, and not 0"));
  write("calib_ir.yaml", yaml_camera("45, 0, 31, 0, 44, 26, 0, 0, 1", "0, 0, 0, 0, 0, 0.1", 6));
  EXPECT_THAT(error(request), HasSubstr("calib_ir.yaml: distortionCoefficients: found 6 coefficients; expected 4, 5"));
  write("calib_ir.yaml", yaml_camera("45, 0, 31, 0, 44, 26, 0, 0, 1", "-9, 0, 0, 0, 0, 9e6, 0, 0", 8));
  EXPECT_THAT(error(request), HasSubstr("calib_ir.yaml: distortionCoefficients: found a rational lens of 8"));
  write("calib_ir.yaml", yaml_camera("45, 0, 31, 0, .Nan, 26, 0, 0, 1", "0, 0, 0, 0, 0"));
  EXPECT_THAT(error(request), HasSubstr("calib_ir.yaml: cameraMatrix: found a number that is not finite"));
  write("calib_ir.yaml", yaml_camera("45, 0, 255, 0, 44, 26, 0, 0, 1", "0, 0, 0, 0, 0"));
  EXPECT_THAT(error(request), HasSubstr("calib_ir.yaml: cameraMatrix: found a principal point of 255, 26 for images"));
  write("calib_ir.yaml", "365 364");
  EXPECT_THAT(error(request), HasSubstr("calib_ir.yaml: is damaged"));
  write("calib_ir.yaml", "%YAML:1.0\ncameraMatrix: !!opencv-matrix\n   rows: 3\n   cols: [");
  EXPECT_THAT(error(request), HasSubstr("calib_ir.yaml: is damaged"));
  calibrate();
  write("calib_pose.yaml", "%YAML:1.0\n" + yaml_matrix("rotation", 3, 3, "1, 0, 0, 0, 1, 0, 0, 0.5, 1") +
                               yaml_matrix("translation", 3, 1, "0, 0, 0"));
  EXPECT_THAT(error(request), HasSubstr("calib_pose.yaml: rotation: found a matrix that is no rotation"));
}

TEST_F(ImportKinect2, SensorsAndRolesAddUp) {
  calibrate();
  import_recording(recording_, of("iai_kinect2", "naked"), root_ / "a");
  ImportRequest request = of("iai_kinect2", "dressed");
  request.with = root_ / "a";
  import_recording(recording_, request, root_ / "b");
  request = of("iai_kinect2", "naked");
  request.sensor = "k2", request.with = root_ / "b", request.first = 2;
  import_recording(recording_, request, root_ / "c");
  request = of("iai_kinect2", "scan_naked");
  request.with = root_ / "c";
  const CaptureSession session = imported(request);
  EXPECT_THAT(session.sensors, ElementsAre("k1", "k2"));
  EXPECT_EQ(session.naked.size(), 2u);
  EXPECT_EQ(session.dressed.size(), 1u);
  EXPECT_EQ(session.naked.at("k2").depth_mm.at<std::uint16_t>(0, 0), 1012);
  EXPECT_EQ(session.scans.at("scan_naked").depth_mm.size(), 3u);
  EXPECT_EQ(session.calibration->sensors.size(), 3u);
  EXPECT_EQ(session.name, "recording");
}

TEST_F(ImportKinect2, WhatDoesNotAddUp) {
  calibrate();
  import_recording(recording_, of("iai_kinect2", "naked"), root_ / "with");
  ImportRequest request = of("iai_kinect2", "naked");
  request.with = root_ / "with";
  EXPECT_THAT(error(request), HasSubstr("--role naked: is taken"));
  request.role = "dressed";
  write("calib_depth.yaml", "%YAML:1.0\ndepthShift: 3\n");
  EXPECT_THAT(error(request), HasSubstr("--sensor k1: found another calibration of this sensor"));
  calibrate();
  request.role = "boards", request.sensor = "k2";
  EXPECT_THAT(error(request), HasSubstr("boards of k1: found 0 shots; expected 3"));
  fs::remove_all(root_ / "with");
  import_recording(recording_, of("iai_kinect2"), root_ / "with");
  request.square_m = 0.028;
  EXPECT_THAT(error(request), HasSubstr("--board: found 5x7x0.028 and 5x7x0.03"));
  request.square_m = 0.03, request.most = 2;
  EXPECT_THAT(error(request), HasSubstr("boards of k2: found 2 shots; expected 3"));
}

TEST_F(ImportKinect2, AHundredBoardsAndMore) {
  for (int i = 0; i < 102; ++i) shot(i);
  EXPECT_EQ(imported(of("iai_kinect2")).boards->shots.at("k1").size(), 102u);
  fs::remove_all(session_);
  ImportRequest request = of("iai_kinect2");
  request.every = 5;
  EXPECT_EQ(imported(request).boards->shots.at("k1").size(), 21u);
}

TEST_F(ImportKinect2, BoardsWithoutDepth) {
  imported(of("iai_kinect2"));
  EXPECT_THAT(report_.notes, testing::Not(testing::Contains(HasSubstr("no depth in"))));
  fs::remove_all(session_);
  for (int i : {0, 3, 12}) image(number(i) + "_sync_depth.png", cv::Mat::zeros(kIr, CV_16UC1));
  imported(of("iai_kinect2"));
  EXPECT_THAT(report_.notes,
              testing::Contains(HasSubstr("no depth in 3 of 3 depth images: every pixel is 0, so that no "
                                          "depth offset can be found from them")));
  fs::remove_all(session_);
  EXPECT_THAT(error(of("iai_kinect2", "scan_user")), HasSubstr("no calibration"));
  calibrate();
  EXPECT_THAT(error(of("iai_kinect2", "scan_user")), HasSubstr("depth images: found no pixel with depth"));
}

TEST_F(ImportKinect2, CalibrationsThatNoKinectHas) {
  const ImportRequest request = of("iai_kinect2", "naked");
  calibrate();
  write("calib_color.yaml", yaml_camera("53, 0., 47, 0., -53, 26, 0., 0., 1.", "0, 0, 0, 0, 0"));
  EXPECT_THAT(error(request), HasSubstr("calib_color.yaml: cameraMatrix: fy: found -53 px"));
  calibrate();
  write("calib_pose.yaml", "%YAML:1.0\n" + yaml_matrix("rotation", 3, 3, "1, 0, 0, 0, 1, 0, 0, 0, 1") +
                               yaml_matrix("translation", 3, 1, "-52, 0, 0"));
  EXPECT_THAT(error(request), HasSubstr("calib_pose.yaml: translation: found a step of 52 m"));
  calibrate();
  write("calib_depth.yaml", "%YAML:1.0\ndepthShift: 25500\n");
  EXPECT_THAT(error(request), HasSubstr("calib_depth.yaml: depthShift: found -25.5 m"));
}

}  // namespace
}  // namespace dressform
