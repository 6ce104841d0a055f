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
        R"({"width": 640, "height": 480, "intrinsic_matrix": [50.5, 0, 0, 0, 51.5, 0, 31.25, 23.75, 1]})");
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

}  // namespace
}  // namespace dressform
