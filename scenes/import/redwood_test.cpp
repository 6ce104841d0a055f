#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/import/import_fixture.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const cv::Size kPrimeSense(640, 480);

using ImportRedwood = Import;

TEST_F(ImportRedwood, ByTimeInTheName) {
  for (int i = 0; i < 3; ++i) {
    image("depth/000000" + std::to_string(i + 1) + "-00000003336" + std::to_string(i) + ".png",
          ramp(kPrimeSense, 700 + i, 0));
    write("rgb/000000" + std::to_string(i + 5) + "-00000003336" + std::to_string(i) + ".jpg", "never opened");
  }
  const CaptureSession session = imported(of("redwood"));
  ASSERT_EQ(session.scans.at("scan_user").depth_mm.size(), 3u);
  EXPECT_EQ(session.scans.at("scan_user").depth_mm[2].at<std::uint16_t>(1, 1), 702);
  EXPECT_EQ(session.calibration->sensors.at("handheld").ir.fx, 525);
}

TEST_F(ImportRedwood, ByNumberWithIntrinsics) {
  for (const char* name : {"00000", "00001", "00010", "00002"}) {
    image("depth/" + std::string(name) + ".png", ramp({64, 48}, std::stoi(name) + 900, 0));
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
        R"({"width": 640, "height": 480, "intrinsic_matrix": [505, 0, 0, 0, 515, 0, 312.5, 237.5, 1]})");
  EXPECT_THAT(error(of("redwood")), HasSubstr("00000.png: found 64 x 48 pixels; expected 640 x 480"));
  write("camera_intrinsic.json", R"({"width": 64, "height": 48, "intrinsic_matrix": [50.5, 0, 31.25, 0]})");
  EXPECT_THAT(error(of("redwood")), HasSubstr("camera_intrinsic.json: intrinsic_matrix"));
}

TEST_F(ImportRedwood, Errors) {
  EXPECT_THAT(error(of("redwood")), HasSubstr("depth: is missing"));
  fs::create_directories(recording_ / "depth");
  EXPECT_THAT(error(of("redwood")), HasSubstr("depth: found no images"));
  image("depth/0000001-000000000000.png", ramp(kPrimeSense, 1, 0));
  image("depth/0000002-000000033333.png", ramp(kPrimeSense, 1, 0));
  write("rgb/0000001-000000900000.jpg", "");
  write("rgb/0000002-000000933333.jpg", "");
  EXPECT_THAT(error(of("redwood")), HasSubstr("depth: found 0 of 2 depth frames with a colour frame within 20 ms"));
  write("rgb/00001.jpg", "");
  EXPECT_THAT(error(of("redwood")), HasSubstr("found names with and without a time"));
  fs::remove_all(recording_ / "rgb");
  image("depth/0000003-000000010000.png", ramp(kPrimeSense, 1, 0));
  EXPECT_THAT(error(of("redwood")), HasSubstr("0000003-000000010000.png: found a number or time that does not"));
  fs::remove(recording_ / "depth/0000003-000000010000.png");
  image("depth/first.png", ramp(kPrimeSense, 1, 0));
  EXPECT_THAT(error(of("redwood")), HasSubstr("first.png: found no number"));
}

// Depth of a wall at 1.5 m and a little further with every frame.
cv::Mat wall(int frame) { return ramp(kPrimeSense, 1500 + frame, 0); }

TEST_F(ImportRedwood, CodesForNoDepth) {
  const cv::Rect hole(150, 100, 250, 100);
  cv::Mat depth = wall(0);
  depth(hole).setTo(65535);
  image("depth/00000.png", depth);
  cv::Mat frame = imported(of("redwood")).scans.at("scan_user").depth_mm[0];
  EXPECT_EQ(cv::countNonZero(frame(hole)), 0);
  EXPECT_EQ(cv::countNonZero(frame == 1500), 640 * 480 - hole.area());
  EXPECT_THAT(report_.notes, testing::Contains(HasSubstr("8.14 % of the depth pixels have 65535")));
  fs::remove_all(session_);
  depth(hole).setTo(4095);
  image("depth/00000.png", depth);
  EXPECT_THAT(error(of("redwood")), HasSubstr("00000.png: found 4095 (0xFFF) in 25000 of 307200 pixels"));
  ImportRequest request = of("redwood");
  request.values["no_depth"] = std::string("4095");
  frame = imported(request).scans.at("scan_user").depth_mm[0];
  EXPECT_EQ(cv::countNonZero(frame(hole)), 0);
}

// A log counts the depth images; the second frame has no colour, the last no pose.
TEST_F(ImportRedwood, KeepsLoggedPoses) {
  for (const int i : {0, 1, 2, 3}) image("depth/0000" + std::to_string(i) + ".png", wall(i));
  for (const int i : {0, 2, 3}) write("color/0000" + std::to_string(i) + ".jpg", "never opened");
  const auto block = [](int frame, double x) {
    return std::to_string(frame) + "\t" + std::to_string(frame) + "\t5\n1 0 0 " + std::to_string(x) +
           "\n0 0 -1 2\n0 1 0 3\n0 0 0 1\n";
  };
  write("trajectory.log", block(0, 1) + block(1, 2) + block(2, 4));
  const CaptureSession session = imported(of("redwood"));
  const auto& poses = session.scans.at("scan_user").world_from_frame;
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_TRUE(poses[0].translation().isApprox(Vector3d(1, 2, 3)));
  EXPECT_TRUE(poses[1].translation().isApprox(Vector3d(4, 2, 3)));
  EXPECT_EQ(poses[1].linear()(2, 1), 1);
  EXPECT_FALSE(poses[2].matrix().allFinite());
  fs::remove_all(session_);
  write("trajectory.log", block(7, 1));
  EXPECT_THAT(error(of("redwood")), HasSubstr("trajectory.log: found a pose of frame 7; expected frames 0 to 3"));
  write("trajectory.log", "0 0 1\n1 0 0 0\n0 1 0 0\n0 0 2 0\n0 0 0 1\n");
  EXPECT_THAT(error(of("redwood")), HasSubstr("trajectory.log:2: found a matrix that is no rotation"));
  write("trajectory.log", "0 0 1\n1 0 0 0\n0 1 0 0\n");
  EXPECT_THAT(error(of("redwood")), HasSubstr("trajectory.log:3: found no more lines"));
}

TEST_F(ImportRedwood, FramesThatRepeat) {
  for (int i = 0; i < 4; ++i) image("depth/0000" + std::to_string(i) + ".png", wall(i));
  imported(of("redwood"));
  EXPECT_THAT(report_.notes, testing::Not(testing::Contains(HasSubstr("identical"))));
  fs::remove_all(session_);
  for (int i : {2, 3}) image("depth/0000" + std::to_string(i) + ".png", wall(1));
  imported(of("redwood"));
  EXPECT_THAT(report_.notes, testing::Contains(HasSubstr("2 of 4 depth frames are identical to an earlier one, bit for "
                                                         "bit (00002.png is 00001.png)")));
}

TEST_F(ImportRedwood, CamerasThatCannotBe) {
  image("depth/00000.png", wall(0));
  const auto with = [&](const std::string& matrix) {
    write("intrinsic.json", R"({"width": 640, "height": 480, "intrinsic_matrix": [)" + matrix + "]}");
    return error(of("redwood"));
  };
  EXPECT_THAT(with("481.2, 0, 0, 0, -480, 0, 319.5, 239.5, 1"),
              HasSubstr("intrinsic.json: intrinsic_matrix: fy: found -480 px; expected a positive focal length"));
  EXPECT_THAT(with("481.2, 0, 0, 0, 480, 0, 959.5, 539.5, 1"), HasSubstr("cx: found a principal point at 959.5 px"));
  EXPECT_THAT(with("481.2, 0, 319.5, 0, 480, 239.5, 0, 0, 1"), HasSubstr("found no camera matrix"));
  fs::remove(recording_ / "intrinsic.json");
  ImportRequest request = of("redwood");
  request.camera = Camera{0, 0, 481.2, -480, 319.5, 239.5, {}};
  EXPECT_THAT(error(request), HasSubstr("--camera: fy: found -480 px"));
}

// Depth on colour's grid makes a shot without infrared.
TEST_F(ImportRedwood, AShotOfColourAndDepth) {
  image("depth/00000.png", wall(0));
  EXPECT_THAT(error(of("redwood", "naked")), HasSubstr("rgb: is missing"));
  image("rgb/00000.png", cv::Mat(kPrimeSense, CV_8UC3, cv::Scalar(1, 2, 3)));
  const CaptureSession session = imported(of("redwood", "naked"));
  EXPECT_TRUE(session.naked.at("k1").ir.empty());
  EXPECT_EQ(session.naked.at("k1").color.at<cv::Vec3b>(9, 9), cv::Vec3b(1, 2, 3));
  const SensorCalibration& sensor = session.calibration->sensors.at("k1");
  EXPECT_EQ(sensor.color->fx, sensor.ir.fx);
  EXPECT_TRUE(sensor.color_from_ir.isApprox(Isometry3d::Identity()));
  fs::remove_all(session_);
  image("rgb/00000.png", cv::Mat(cv::Size(1280, 960), CV_8UC3, cv::Scalar(1, 2, 3)));
  EXPECT_THAT(error(of("redwood", "naked")), HasSubstr("expected depth on colour's grid, so images of one size"));
}

}  // namespace
}  // namespace dressform
