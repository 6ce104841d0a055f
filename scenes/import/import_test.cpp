#include "scenes/import/import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/import/stamped_files.h"
#include "scenes/scene_fields.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

// A fresh folder for every test, with a recording that the test writes and the session made of it.
class Import : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(testing::TempDir()) /
            ("import_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(root_);
    fs::create_directories(recording_ = root_ / "recording");
    session_ = root_ / "session";
  }
  void TearDown() override { fs::remove_all(root_); }

  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((recording_ / name).parent_path());
    std::ofstream(recording_ / name) << text;
  }
  void picture(const std::string& name, const cv::Mat& image) const {
    fs::create_directories((recording_ / name).parent_path());
    cv::imwrite((recording_ / name).string(), image);
  }

  CaptureSession imported(const ImportRequest& request) {
    report_ = import_recording(recording_, request, session_);
    return read_capture_session(session_);
  }
  // The error, after which nothing may be left behind.
  std::string error(const ImportRequest& request) const {
    try {
      import_recording(recording_, request, session_);
    } catch (const InputError& error) {
      for (const auto& entry : fs::directory_iterator(root_))
        EXPECT_THAT((std::vector<fs::path>{recording_, root_ / "with"}), testing::Contains(entry.path()));
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.what();
    }
    return "no error";
  }

  fs::path root_, recording_, session_;
  ImportReport report_;
};

ImportRequest of(const std::string& format, const std::string& role = {}) {
  ImportRequest request;
  request.format = format;
  request.role = role;
  return request;
}

cv::Mat ramp(cv::Size size, int from, int step) {
  cv::Mat image(size, CV_16UC1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      image.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(from + step * (x + size.width * y));
  return image;
}

const cv::Size kTum(640, 480), kIr(64, 53), kColor(96, 54);

// ---- TUM

class ImportTum : public Import {
 protected:
  // Four depth frames at 0.1 s, colour 5 ms later.
  void SetUp() override {
    Import::SetUp();
    std::string depth = "# depth maps\n# file: 'x.bag'\n", color = "# color images\n";
    for (int i = 0; i < 4; ++i) {
      const std::string stamp = "130503." + std::to_string(1 + i);
      picture("depth/" + stamp + ".png", ramp(kTum, 5000 * (i + 1), 0));
      depth += stamp + "00000 depth/" + stamp + ".png\n";
      color += stamp + "05000 rgb/" + stamp + ".png\r\n";
    }
    write("depth.txt", depth);
    write("rgb.txt", color);
  }
};

TEST_F(ImportTum, MillimetresAndCameraAreExact) {
  cv::Mat depth(kTum, CV_16UC1, cv::Scalar(0));
  const std::vector<std::pair<int, int>> raw_and_mm{{0, 0},       {1, 0},       {2, 0},        {3, 1},
                                                    {5, 1},       {7, 1},       {8, 2},        {4997, 999},
                                                    {5000, 1000}, {5003, 1001}, {10500, 2100}, {65535, 13107}};
  for (std::size_t i = 0; i < raw_and_mm.size(); ++i)
    depth.at<std::uint16_t>(7, static_cast<int>(i)) = static_cast<std::uint16_t>(raw_and_mm[i].first);
  picture("depth/130503.1.png", depth);
  const CaptureSession session = imported(of("tum"));
  const DepthScan& scan = session.scans.at("scan_user");
  ASSERT_EQ(scan.depth_mm.size(), 4u);
  for (std::size_t i = 0; i < raw_and_mm.size(); ++i)
    EXPECT_EQ(scan.depth_mm[0].at<std::uint16_t>(7, static_cast<int>(i)), raw_and_mm[i].second) << raw_and_mm[i].first;
  for (int i = 1; i < 4; ++i)
    EXPECT_EQ(cv::norm(scan.depth_mm[i], cv::Mat(kTum, CV_16UC1, cv::Scalar(1000 * (i + 1))), cv::NORM_INF), 0);
  const SensorCalibration& sensor = session.calibration->sensors.at(scan.sensor);
  EXPECT_EQ(sensor.model, "kinect_v1");
  EXPECT_FALSE(sensor.color);
  EXPECT_EQ(sensor.ir.width, 640);
  EXPECT_EQ(sensor.ir.height, 480);
  EXPECT_EQ(sensor.ir.fx, 525);
  EXPECT_EQ(sensor.ir.fy, 525);
  EXPECT_EQ(sensor.ir.cx, 319.5);
  EXPECT_EQ(sensor.ir.cy, 239.5);
  EXPECT_EQ(sensor.depth_offset_m, 0);
  EXPECT_EQ(session.name, "recording");
  EXPECT_EQ(session.licence, "unknown");
}

TEST_F(ImportTum, FramesWithoutColourAreLeftOutAndCounted) {
  write("rgb.txt", "130503.105 rgb/a.png\n130503.29 rgb/b.png\n130503.401 rgb/c.png\n130503.402 rgb/d.png\n");
  const CaptureSession session = imported(of("tum", "scan_naked"));
  const auto& frames = session.scans.at("scan_naked").depth_mm;
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[0].at<std::uint16_t>(0, 0), 1000);
  EXPECT_EQ(frames[1].at<std::uint16_t>(0, 0), 3000);
  EXPECT_EQ(frames[2].at<std::uint16_t>(0, 0), 4000);
  EXPECT_THAT(report_.notes, testing::Contains(HasSubstr("1 of 4 depth frames left out")));
}

TEST_F(ImportTum, ChosenFramesCameraAndNames) {
  ImportRequest request = of("tum");
  request.first = 1, request.every = 2;
  request.sensor = "xtion", request.model = "xtion", request.name = "desk", request.licence = "CC-BY-4.0";
  request.camera = Camera{0, 0, 517.3, 516.5, 318.6, 255.3, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}};
  const CaptureSession session = imported(request);
  EXPECT_EQ(session.scans.at("scan_user").depth_mm.size(), 2u);
  EXPECT_EQ(session.scans.at("scan_user").depth_mm[1].at<std::uint16_t>(9, 9), 4000);
  EXPECT_EQ(session.calibration->sensors.at("xtion").ir.fx, 517.3);
  EXPECT_EQ(session.calibration->sensors.at("xtion").ir.distortion[4], 1.1633);
  EXPECT_EQ(session.calibration->sensors.at("xtion").model, "xtion");
  EXPECT_EQ(session.name, "desk");
  EXPECT_EQ(session.licence, "CC-BY-4.0");
}

TEST_F(ImportTum, TheSameBytesForOneAndTwoThreads) {
  for (int threads = 1; threads <= 2; ++threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    import_recording(recording_, of("tum"), root_ / std::to_string(threads));
  }
  EXPECT_EQ(session_content_hash(root_ / "1"), session_content_hash(root_ / "2"));
}

TEST_F(ImportTum, Unsynchronised) {
  write("rgb.txt", "130504.1 rgb/a.png\n130504.2 rgb/b.png\n");
  EXPECT_THAT(error(of("tum")), HasSubstr("depth.txt: found 0 of 4 depth frames with a colour frame within 20 ms"));
  ImportRequest patient = of("tum");
  patient.values["tolerance_ms"] = std::string("2000");
  EXPECT_THAT(error(patient), HasSubstr("tolerance_ms"));  // a second at most
}

TEST_F(ImportTum, ListErrors) {
  write("depth.txt", "130503.2 depth/130503.2.png\n130503.1 depth/130503.1.png\n");
  EXPECT_THAT(error(of("tum")), HasSubstr("depth.txt:2: found stamp 130503.100000 after 130503.200000"));
  write("depth.txt", "# nothing\n\n");
  EXPECT_THAT(error(of("tum")), HasSubstr("depth.txt: found no images"));
  write("depth.txt", "# x\nnoon depth/130503.1.png\n");
  EXPECT_THAT(error(of("tum")), HasSubstr("depth.txt:2: found \"noon depth/130503.1.png\"; expected a stamp"));
  write("depth.txt", "130503.1\n");
  EXPECT_THAT(error(of("tum")), HasSubstr("depth.txt:1: found \"130503.1\""));
  write("depth.txt", "130503.1 ../../etc/passwd\n");
  EXPECT_THAT(error(of("tum")), HasSubstr("expected a path inside the recording"));
  write("depth.txt", "nan depth/130503.1.png\n");
  EXPECT_THAT(error(of("tum")), HasSubstr("depth.txt:1"));
  fs::remove(recording_ / "depth.txt");
  EXPECT_THAT(error(of("tum")), HasSubstr("depth.txt: is missing"));
}

TEST_F(ImportTum, ImageErrors) {
  picture("depth/130503.3.png", ramp({320, 240}, 1, 0));
  EXPECT_THAT(error(of("tum")), HasSubstr("130503.3.png: found 320 x 240 pixels; expected 640 x 480"));
  picture("depth/130503.3.png", cv::Mat(kTum, CV_8UC1, cv::Scalar(1)));
  EXPECT_THAT(error(of("tum")), HasSubstr("130503.3.png: found 8-bit grey; expected 16-bit grey"));
  std::string bytes = read_file_bytes(recording_ / "depth/130503.2.png");
  std::ofstream(recording_ / "depth/130503.3.png", std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  EXPECT_THAT(error(of("tum")), HasSubstr("130503.3.png: is damaged"));
  fs::remove(recording_ / "depth/130503.3.png");
  EXPECT_THAT(error(of("tum")), HasSubstr("130503.3.png: is missing"));
}

TEST_F(ImportTum, NoCalibrationForAnotherSize) {
  for (int i = 1; i <= 4; ++i) picture("depth/130503." + std::to_string(i) + ".png", ramp({320, 240}, 1, 0));
  EXPECT_THAT(error(of("tum")), HasSubstr("130503.1.png: found no calibration for 320 x 240 pixels"));
  ImportRequest request = of("tum");
  request.camera = Camera{0, 0, 262, 262, 159.5, 119.5, {}};
  EXPECT_EQ(imported(request).calibration->sensors.at("handheld").ir.width, 320);
}

TEST_F(ImportTum, WhatTheSessionDoesNotAllow) {
  EXPECT_THAT(error(of("tum", "naked")), HasSubstr("no infrared pictures"));
  EXPECT_THAT(error(of("tum", "boards")), HasSubstr("expected --role scan_naked or scan_user"));
  EXPECT_THAT(error(of("tum", "party")), HasSubstr("--role party"));
  ImportRequest request = of("tum");
  request.sensor = "../x";
  EXPECT_THAT(error(request), HasSubstr("--sensor ../x"));
  request = of("tum");
  request.first = 4;
  EXPECT_THAT(error(request), HasSubstr("found 4 frames; expected one from --first 4"));
  request = of("tum");
  request.world_from_sensor = Isometry3d::Identity();
  EXPECT_THAT(error(request), HasSubstr("--place"));
  EXPECT_THAT(error(of("sonar")), HasSubstr("variant of import: found \"sonar\"; expected one of"));
  fs::create_directories(session_);
  EXPECT_THROW(import_recording(recording_, of("tum"), session_), InputError);
  EXPECT_TRUE(fs::is_empty(session_));
}

// ---- Redwood

TEST_F(Import, RedwoodByTimeInTheName) {
  for (int i = 0; i < 3; ++i) {
    picture("depth/000000" + std::to_string(i + 1) + "-00000003336" + std::to_string(i) + ".png",
            ramp(kTum, 700 + i, 0));
    write("rgb/000000" + std::to_string(i + 5) + "-00000003336" + std::to_string(i) + ".jpg", "never opened");
  }
  const CaptureSession session = imported(of("redwood"));
  ASSERT_EQ(session.scans.at("scan_user").depth_mm.size(), 3u);
  EXPECT_EQ(session.scans.at("scan_user").depth_mm[2].at<std::uint16_t>(1, 1), 702);
  EXPECT_EQ(session.calibration->sensors.at("handheld").ir.fx, 525);
}

TEST_F(Import, RedwoodByNumberWithIntrinsics) {
  for (const char* name : {"00000", "00001", "00010", "00002"}) {
    picture("depth/" + std::string(name) + ".png", ramp({64, 48}, std::stoi(name) + 900, 0));
    write("image/" + std::string(name) + ".jpg", "never opened");
  }
  write("camera_intrinsic.json",
        R"({"width": 64, "height": 48, "intrinsic_matrix": [50.5, 0, 0, 0, 51.5, 0, 31.25, 23.75, 1]})");
  const CaptureSession session = imported(of("redwood", "scan_naked"));
  const auto& frames = session.scans.at("scan_naked").depth_mm;
  ASSERT_EQ(frames.size(), 4u);
  EXPECT_EQ(frames[3].at<std::uint16_t>(0, 0), 910);
  const Camera& camera = session.calibration->sensors.at("handheld").ir;
  EXPECT_EQ(camera.fx, 50.5);
  EXPECT_EQ(camera.fy, 51.5);
  EXPECT_EQ(camera.cx, 31.25);
  EXPECT_EQ(camera.cy, 23.75);
  fs::remove_all(session_);
  write("camera_intrinsic.json",
        R"({"width": 640, "height": 480, "intrinsic_matrix": [50.5, 0, 0, 0, 51.5, 0, 31.25, 23.75, 1]})");
  EXPECT_THAT(error(of("redwood")), HasSubstr("00000.png: found 64 x 48 pixels; expected 640 x 480"));
  write("camera_intrinsic.json", R"({"width": 64, "height": 48, "intrinsic_matrix": [50.5, 0, 31.25, 0]})");
  EXPECT_THAT(error(of("redwood")), HasSubstr("camera_intrinsic.json: intrinsic_matrix"));
}

TEST_F(Import, RedwoodErrors) {
  EXPECT_THAT(error(of("redwood")), HasSubstr("depth: is missing"));
  fs::create_directories(recording_ / "depth");
  EXPECT_THAT(error(of("redwood")), HasSubstr("depth: found no images"));
  picture("depth/0000001-000000000000.png", ramp(kTum, 1, 0));
  picture("depth/0000002-000000033333.png", ramp(kTum, 1, 0));
  write("rgb/0000001-000000900000.jpg", "");
  write("rgb/0000002-000000933333.jpg", "");
  EXPECT_THAT(error(of("redwood")), HasSubstr("depth: found 0 of 2 depth frames with a colour frame within 20 ms"));
  write("rgb/00001.jpg", "");
  EXPECT_THAT(error(of("redwood")), HasSubstr("found names with and without a time"));
  fs::remove_all(recording_ / "rgb");
  picture("depth/0000003-000000010000.png", ramp(kTum, 1, 0));
  EXPECT_THAT(error(of("redwood")), HasSubstr("0000003-000000010000.png: found a number or time that does not"));
  fs::remove(recording_ / "depth/0000003-000000010000.png");
  picture("depth/first.png", ramp(kTum, 1, 0));
  EXPECT_THAT(error(of("redwood")), HasSubstr("first.png: found no number"));
}

// ---- iai_kinect2

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
    picture(number(i) + sync + "_color.png", cv::Mat(kColor, CV_8UC1, cv::Scalar(40 + i)));
    picture(number(i) + sync + "_ir.png", ramp(kIr, 100 * i, 1));
    picture(number(i) + sync + "_depth.png", ramp(kIr, 1000 + i, 0));
    picture(number(i) + sync + "_grey_ir.png", cv::Mat(kIr, CV_8UC1, cv::Scalar(3)));
    write(number(i) + sync + "_ir_points.yaml", "%YAML:1.0\n");
  }
  void calibrate() const {
    write("calib_color.yaml",
          yaml_camera("1060.5, 0., 47.25, 0., 1058.5, 26.5, 0., 0., 1.", "0.05, -0.06, 1e-3, -2e-3, 0.02"));
    write("calib_ir.yaml", yaml_camera("365.5, 0., 31.5, 0., 364.5, 26.25, 0., 0., 1.", "0.09, -0.27, 0., 0., 0.1"));
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
  EXPECT_EQ(sensor.ir.fx, 365.5);
  EXPECT_EQ(sensor.ir.cy, 26.25);
  EXPECT_EQ(sensor.ir.distortion[1], -0.27);
  EXPECT_EQ(sensor.color->height, kColor.height);
  EXPECT_EQ(sensor.color->fy, 1058.5);
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
  EXPECT_EQ(session.calibration->sensors.at("handheld").ir.fx, 365.5);
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
    picture(number(i) + "_depth.png", ramp(kIr, 900, 0));
    write(number(i) + "_color.jpg", "never opened");
    write(number(i) + "_depth_colored.png", "never opened");
  }
  calibrate();
  SensorCalibration sensor = imported(of("iai_kinect2", "scan_user")).calibration->sensors.at("handheld");
  EXPECT_EQ(sensor.ir.fx, 365.5);
  EXPECT_EQ(sensor.ir.distortion[0], 0);
  EXPECT_EQ(sensor.depth_offset_m, 0);
  fs::remove_all(session_);
  for (int i = 0; i < 2; ++i) picture(number(i) + "_depth.png", ramp({96, 54}, 900, 0));  // 1920 x 1080 by 20
  write("calib_color.yaml", yaml_camera("1060, 0., 960, 0., 1058, 530, 0., 0., 1.", "0.05, -0.06, 0, 0, 0.02"));
  sensor = imported(of("iai_kinect2", "scan_user")).calibration->sensors.at("handheld");
  EXPECT_EQ(sensor.ir.width, 96);
  EXPECT_DOUBLE_EQ(sensor.ir.fx, 53);
  EXPECT_DOUBLE_EQ(sensor.ir.cy, 26.5);
  EXPECT_EQ(sensor.ir.distortion[0], 0);
}

TEST_F(ImportKinect2, ImageErrors) {
  fs::remove(recording_ / "0003_sync_ir.png");
  EXPECT_THAT(error(of("iai_kinect2")), HasSubstr("0003_sync_ir.png: is missing; expected color, ir and depth"));
  shot(3);
  picture("0003_sync_ir.png", ramp({62, 53}, 0, 1));
  EXPECT_THAT(error(of("iai_kinect2")), HasSubstr("0003_sync_ir.png: found 62 x 53 pixels; expected 64 x 53"));
  picture("0003_sync_ir.png", cv::Mat(kIr, CV_8UC1, cv::Scalar(9)));
  EXPECT_THAT(error(of("iai_kinect2")), HasSubstr("0003_sync_ir.png: found 8-bit grey; expected 16-bit grey"));
  shot(3);
  picture("0012_sync_color.png", cv::Mat(kColor, CV_8UC4, cv::Scalar::all(7)));
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
  write("calib_ir.yaml", "%YAML:1.0\n" + yaml_matrix("cameraMatrix", 3, 3, "365, 0, 31, 0, 364, 26, 0, 0, 1"));
  EXPECT_THAT(error(request), HasSubstr("calib_ir.yaml: distortionCoefficients: is missing"));
  write("calib_ir.yaml", yaml_camera("365, 0, 31, 0, 364, 26, 0, 0, 1", "0, 0, 0, 0, 0, 0.1, 0.2, 0.3", 8));
  EXPECT_THAT(error(request), HasSubstr("calib_ir.yaml: distortionCoefficients: found 8 coefficients"));
  write("calib_ir.yaml", yaml_camera("365, 0, 31, 0, .Nan, 26, 0, 0, 1", "0, 0, 0, 0, 0"));
  EXPECT_THAT(error(request), HasSubstr("calib_ir.yaml: cameraMatrix: found a number that is not finite"));
  write("calib_ir.yaml", yaml_camera("365, 0, 255, 0, 364, 26, 0, 0, 1", "0, 0, 0, 0, 0"));
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

TEST_F(ImportKinect2, MoreBoardsThanASessionHolds) {
  for (int i = 0; i < 101; ++i) shot(i);
  EXPECT_THAT(error(of("iai_kinect2")), HasSubstr("found 101 frames; expected 100 at most"));
  ImportRequest request = of("iai_kinect2");
  request.every = 5;
  EXPECT_EQ(imported(request).boards->shots.at("k1").size(), 21u);
}

TEST(Associate, NearestFirstAndEachOnce) {
  const std::vector<StampedFile> a{{0.00, ""}, {0.10, ""}, {0.12, ""}, {0.50, ""}},
      b{{0.01, ""}, {0.115, ""}, {0.9, ""}};
  EXPECT_THAT(associate(a, b, 0.02), ElementsAre(std::pair(0, 0), std::pair(2, 1)));
  EXPECT_THAT(associate(a, b, 0.4), ElementsAre(std::pair(0, 0), std::pair(2, 1), std::pair(3, 2)));
  EXPECT_THAT(associate(a, {}, 1), ElementsAre());
}

TEST(Importers, OneForEachFormat) {
  EXPECT_THAT(Importer::names(), UnorderedElementsAre("iai_kinect2", "redwood", "tum"));
}

}  // namespace
}  // namespace dressform
