#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/import/import_fixture.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;

const cv::Size kDepth(64, 48), kColor(128, 72);

const char* const kCameras = R"(
[calibration]
model = "realsense_d435"
ir = {width = 64, height = 48, fx = 50.0, fy = 50.0, cx = 31.5, cy = 23.5}
color = {width = 128, height = 72, fx = 90.0, fy = 90.0, cx = 63.5, cy = 35.5}
color_from_ir = {rotation = [[1, 0, 0], [0, 1, 0], [0, 0, 1]], translation_m = [0.015, 0, 0]}
)";

class ImportGeneric : public Import {
 protected:
  // Stamps in milliseconds; colour two milliseconds later.
  void SetUp() override {
    Import::SetUp();
    for (int i = 0; i < 3; ++i) {
      image("Depth_" + std::to_string(1700000000100 + 33 * i) + ".250.png", ramp(kDepth, 4 * (1500 + i), 0));
      image("rgb/Color_" + std::to_string(1700000000102 + 33 * i) + ".png",
            cv::Mat(kColor, CV_8UC3, cv::Scalar(i, 2, 3)));
    }
    layout(std::string("[depth]\nfiles = \"Depth_{stamp}.png\"\nper_m = 4000\n[color]\nfiles = "
                       "\"rgb/*_{stamp}.png\"\n[stamps]\nunit_s = 1e-3\ntolerance_ms = 5\n") +
           kCameras);
  }
  void layout(const std::string& text) const { write("layout.toml", text); }
  ImportRequest request(const std::string& role = {}) const {
    ImportRequest request = of("generic", role);
    request.values["layout"] = (recording_ / "layout.toml").string();
    return request;
  }
};

TEST_F(ImportGeneric, StampsScaleAndCameras) {
  CaptureSession session = imported(request());
  EXPECT_EQ(session.scans.at("scan_user").depth_mm[2].at<std::uint16_t>(3, 3), 1502);
  EXPECT_FALSE(session.naked.count("k1"));
  fs::remove_all(session_);
  session = imported(request("naked"));
  EXPECT_EQ(session.naked.at("k1").depth_mm.at<std::uint16_t>(3, 3), 1500);
  EXPECT_EQ(session.naked.at("k1").color.at<cv::Vec3b>(3, 3), cv::Vec3b(0, 2, 3));
  const SensorCalibration& sensor = session.calibration->sensors.at("k1");
  EXPECT_EQ(sensor.model, "realsense_d435");
  EXPECT_EQ(sensor.color->fx, 90);
  EXPECT_EQ(sensor.color_from_ir.translation(), Vector3d(0.015, 0, 0));
}

TEST_F(ImportGeneric, FramesRolesCodesAndOneGrid) {
  fs::remove_all(recording_);
  for (int i : {7, 40, 300}) {  // as scanners number them: without zeros, one folder a frame
    cv::Mat depth = ramp(kDepth, 2000, 0);
    depth.at<std::uint16_t>(0, 0) = 4095, depth.at<std::uint16_t>(0, 1) = 65535;
    image("frame-" + std::to_string(i) + "/depth.png", depth);
    image("frame-" + std::to_string(i) + "/color.png", cv::Mat(kDepth, CV_8UC3, cv::Scalar(i % 256, 2, 3)));
    image("frame-" + std::to_string(i) + "/ir.png", ramp(kDepth, i, 0));
  }
  layout(
      "role = \"dressed\"\nsensor = \"left\"\n[depth]\nfiles = \"frame-{frame}/depth.png\"\nno_depth = [4095]\n"
      "on_color_grid = true\n[color]\nfiles = \"frame-{frame}/color.png\"\n[ir]\nfiles = \"frame-{frame}/ir.png\"\n"
      "[calibration]\nir = {width = 64, height = 48, fx = 50.0, fy = 50.0, cx = 31.5, cy = 23.5}\n");
  ImportRequest second = request();
  second.first = 1;
  const CaptureSession session = imported(second);
  const Shot& shot = session.dressed.at("left");
  EXPECT_EQ(shot.ir.at<std::uint16_t>(0, 0), 40);
  EXPECT_EQ(shot.depth_mm.at<std::uint16_t>(0, 0), 0);
  EXPECT_EQ(shot.depth_mm.at<std::uint16_t>(0, 1), 0);
  EXPECT_EQ(shot.depth_mm.at<std::uint16_t>(0, 2), 2000);
  EXPECT_EQ(session.calibration->sensors.at("left").color->fx, 50);
}

TEST_F(ImportGeneric, Lists) {
  write("depth.txt", "# ms path\n10 Depth_1700000000100.250.png\n43 Depth_1700000000133.250.png\n");
  layout(std::string("[depth]\nlist = \"depth.txt\"\nper_m = 4000\n[stamps]\nunit_s = 1e-3\n") + kCameras);
  EXPECT_EQ(imported(request()).scans.at("scan_user").depth_mm.size(), 2u);
  fs::remove_all(session_);
  write("depth.txt", "43 Depth_1700000000133.250.png\n10 Depth_1700000000100.250.png\n");
  EXPECT_THAT(error(request()), HasSubstr("depth.txt:2: found stamp"));
}

TEST_F(ImportGeneric, Errors) {
  EXPECT_THAT(error(of("generic")), HasSubstr("--layout: is missing"));
  EXPECT_THAT(error(request("boards")), HasSubstr("found no infrared image of frame 0"));
  const auto with = [&](const std::string& text) {
    layout(text);
    return error(request());
  };
  EXPECT_THAT(with("role = 3\n[depth]\nfiles = \"{frame}.png\"\n"), HasSubstr("layout.toml:1:8"));
  EXPECT_THAT(with("[depth]\nfiles = \"../{frame}.png\"\n"), HasSubstr("expected a path inside the recording"));
  EXPECT_THAT(with("[depth]\nfiles = \"{frame}{stamp}.png\"\n"), HasSubstr("one {frame} or one {stamp}"));
  EXPECT_THAT(with("[depth]\nfiles = \"none_{frame}.png\"\n"), HasSubstr("found no file like \"none_{frame}.png\""));
  EXPECT_THAT(with("[depth]\nper_m = 1000\n"), HasSubstr("expected either `files`"));
  EXPECT_THAT(with("[depth]\nfiles = \"{frame}.png\"\nno_depth = [70000]\n"),
              HasSubstr("depth.no_depth: expected whole"));
  EXPECT_THAT(with("[depth]\nfiles = \"{frame}.png\"\nscale = 3\n"), HasSubstr("unknown key \"scale\" in depth"));
  EXPECT_THAT(with("[color]\nfiles = \"{frame}.png\"\n"), HasSubstr("found no [depth]"));
  EXPECT_THAT(with("[depth]\nfiles = \"Depth_{stamp}.png\"\nper_m = 4000\n"),
              HasSubstr("found no calibration for 64 x 48"));
  EXPECT_THAT(with(std::string("[depth]\nfiles = \"Depth_{stamp}.png\"\n") + kCameras +
                   "[color]\nfiles = "
                   "\"rgb/Color_{frame}.png\"\n"),
              HasSubstr("expected the same kind in all"));
  EXPECT_THAT(with(std::string("[depth]\nfiles = \"Depth_{stamp}.png\"\nper_m = 400\n") + kCameras),
              HasSubstr("depth.per_m of the layout=... says another scale"));
  EXPECT_THAT(with("[depth]\nfiles = \"Depth_{stamp}.png\"\n[calibration]\nir = {width = 64, height = 48, fx = 50.0, "
                   "fy = -50.0, cx = 31.5, cy = 23.5}\n"),
              HasSubstr("ir.fy: found -50"));
}

}  // namespace
}  // namespace dressform
