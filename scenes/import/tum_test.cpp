#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <fstream>

#include "scenes/file_bytes.h"
#include "scenes/import/import_fixture.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const cv::Size kTum(640, 480);

class ImportTum : public Import {
 protected:
  // Four depth frames at 0.1 s, colour 5 ms later.
  void SetUp() override {
    Import::SetUp();
    std::string depth = "# depth maps\n# file: 'x.bag'\n", color = "# color images\n";
    for (int i = 0; i < 4; ++i) {
      const std::string stamp = "130503." + std::to_string(1 + i);
      image("depth/" + stamp + ".png", ramp(kTum, 5000 * (i + 1), 0));
      depth += stamp + "00000 depth/" + stamp + ".png\n";
      color += stamp + "05000 rgb/" + stamp + ".png\r\n";
    }
    write("depth.txt", depth);
    write("rgb.txt", color);
  }
};

TEST_F(ImportTum, MillimetresAndCameraAreExact) {
  cv::Mat depth(kTum, CV_16UC1, cv::Scalar(0));
  const std::vector<std::pair<int, int>> raw_and_mm{
      {0, 0},      {1, 0},       {2, 0},       {3, 1},        {5, 1},         {7, 1},    {8, 2},
      {4997, 999}, {5000, 1000}, {5003, 1001}, {10500, 2100}, {65534, 13107}, {65535, 0}};
  for (std::size_t i = 0; i < raw_and_mm.size(); ++i)
    depth.at<std::uint16_t>(7, static_cast<int>(i)) = static_cast<std::uint16_t>(raw_and_mm[i].first);
  image("depth/130503.1.png", depth);
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

// Poses by motion capture, between whose moments the frames were taken; for a while the camera was not seen.
TEST_F(ImportTum, KeepsRecordedPoses) {
  write("groundtruth.txt",
        "# stamp tx ty tz qx qy qz qw\n130503.09 1 0 0 0 0 0 1\n130503.11 3 0 0 0 0 0.7071 0.7071\n"
        "130503.2 4 5 6 0 0 0 1\n130503.28 0 0 0 0 0 0 1\n130503.36 0 0 0 0 0 0 1\n");
  const CaptureSession session = imported(of("tum"));
  const auto& poses = session.scans.at("scan_user").world_from_frame;
  ASSERT_EQ(poses.size(), 4u);
  EXPECT_TRUE(poses[0].translation().isApprox(Vector3d(2, 0, 0), 1e-6));
  EXPECT_NEAR(Eigen::AngleAxisd(poses[0].linear()).angle(), M_PI / 4, 1e-4);
  EXPECT_TRUE(poses[1].translation().isApprox(Vector3d(4, 5, 6)));
  EXPECT_FALSE(poses[2].matrix().allFinite()) << "80 ms between two poses";
  EXPECT_FALSE(poses[3].matrix().allFinite()) << "after the last one";
  EXPECT_THAT(report_.notes, testing::Contains(HasSubstr("2 of 4 frames have a recorded pose")));
  // Another import into the same session takes them along.
  fs::rename(session_, root_ / "with");
  ImportRequest more = of("tum", "scan_naked");
  more.with = root_ / "with";
  const CaptureSession both = imported(more);
  EXPECT_EQ(both.scans.at("scan_user").world_from_frame.size(), 4u);
  EXPECT_EQ(both.scans.at("scan_naked").world_from_frame.size(), 4u);
  fs::remove_all(session_);
  write("groundtruth.txt", "130503.09 1 0 0 0 0 0 1\n130503.1 1 0 0 0 0 0 2\n");
  EXPECT_THAT(error(of("tum")), HasSubstr("groundtruth.txt:2: found a quaternion of length 2"));
  write("groundtruth.txt", "130503.09 1 0 0 0 0 1\n");
  EXPECT_THAT(error(of("tum")), HasSubstr("groundtruth.txt:1: found \"130503.09 1 0 0 0 0 1\"; expected a stamp"));
  write("groundtruth.txt", "130503.09 1 0 0 0 0 0 1\n130503.09 1 0 0 0 0 0 1\n");
  EXPECT_THAT(error(of("tum")), HasSubstr("groundtruth.txt:2: found stamp 130503.090000 after"));
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
  image("depth/130503.3.png", ramp({320, 240}, 1, 0));
  EXPECT_THAT(error(of("tum")), HasSubstr("130503.3.png: found 320 x 240 pixels; expected 640 x 480"));
  image("depth/130503.3.png", cv::Mat(kTum, CV_8UC1, cv::Scalar(1)));
  EXPECT_THAT(error(of("tum")), HasSubstr("130503.3.png: found 8-bit grey; expected 16-bit grey"));
  std::string bytes = read_file_bytes(recording_ / "depth/130503.2.png");
  std::ofstream(recording_ / "depth/130503.3.png", std::ios::binary) << bytes.substr(0, bytes.size() / 2);
  EXPECT_THAT(error(of("tum")), HasSubstr("130503.3.png: is damaged"));
  fs::remove(recording_ / "depth/130503.3.png");
  EXPECT_THAT(error(of("tum")), HasSubstr("130503.3.png: is missing"));
}

// A person at 2.1 m before a wall at 4 m, in millimetres, read at the benchmark's 5000 a metre.
TEST_F(ImportTum, DepthInAnotherScale) {
  for (int i = 1; i <= 4; ++i) {
    cv::Mat depth = ramp(kTum, 4000 + i, 0);
    depth(cv::Rect(250, 80, 140, 380)).setTo(2100 + i);
    image("depth/130503." + std::to_string(i) + ".png", depth);
  }
  const std::string text = error(of("tum"));
  EXPECT_THAT(text, HasSubstr("recording: depth images: found depth of 0.81 m in the middle (0.42 to 0.81 m in 80 % of "
                              "the pixels); expected 0.45 to 10 m"));
  EXPECT_THAT(text, HasSubstr("(looks like millimetres, 1000 a metre)"));
  EXPECT_THAT(text, HasSubstr("counted as 5000 a metre: --set import.depth_per_m=... says another scale"));
  ImportRequest request = of("tum");
  request.values["depth_per_m"] = std::string("1000");
  EXPECT_EQ(imported(request).scans.at("scan_user").depth_mm[0].at<std::uint16_t>(200, 300), 2101);
}

TEST_F(ImportTum, NoCalibrationForAnotherSize) {
  for (int i = 1; i <= 4; ++i) image("depth/130503." + std::to_string(i) + ".png", ramp({320, 240}, 7500 + i, 0));
  EXPECT_THAT(error(of("tum")), HasSubstr("130503.1.png: found no calibration for 320 x 240 pixels"));
  ImportRequest request = of("tum");
  request.camera = Camera{0, 0, 262, 262, 159.5, 119.5, {}};
  EXPECT_EQ(imported(request).calibration->sensors.at("handheld").ir.width, 320);
}

TEST_F(ImportTum, WhatTheSessionDoesNotAllow) {
  EXPECT_THAT(error(of("tum", "boards")), HasSubstr("no infrared images"));
  EXPECT_THAT(error(of("tum", "boards")), HasSubstr("expected --role naked, dressed, scan_naked or"));
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

}  // namespace
}  // namespace dressform
