#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "scenes/import/import_fixture.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;

const cv::Size kSize(64, 48);

class ImportBop : public Import {
 protected:
  void SetUp() override {
    Import::SetUp();
    for (int i : {0, 3, 12}) {
      char name[16];
      std::snprintf(name, sizeof name, "%06d.png", i);
      image(std::string("depth/") + name, ramp(kSize, 20000 + 10 * i, 0));
      image(std::string("rgb/") + name, cv::Mat(kSize, CV_8UC3, cv::Scalar(i, 2, 3)));
    }
    write("scene_camera.json", cameras().dump());
  }
  static json cameras() {
    json file;
    for (int i : {0, 3, 12})
      file[std::to_string(i)] = {{"cam_K", {57.25, 0, 32.5, 0, 57.4, 24.2, 0, 0, 1}},
                                 {"depth_scale", 0.1},
                                 {"cam_R_w2c", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
                                 {"cam_t_w2c", {0, 0, 700}}};
    return file;
  }
  std::string error_after(const std::function<void(json&)>& change) {
    json file = cameras();
    change(file);
    write("scene_camera.json", file.dump());
    return error(of("bop"));
  }
};

TEST_F(ImportBop, ScanAndShot) {
  CaptureSession session = imported(of("bop"));
  const DepthScan& scan = session.scans.at("scan_user");
  ASSERT_EQ(scan.depth_mm.size(), 3u);
  EXPECT_EQ(scan.depth_mm[1].at<std::uint16_t>(7, 7), 2003);
  const Camera& camera = session.calibration->sensors.at("handheld").ir;
  EXPECT_EQ(camera.width, 64);
  EXPECT_EQ(camera.fy, 57.4);
  EXPECT_EQ(camera.cx, 32.5);
  EXPECT_THAT(report_.notes, Contains(HasSubstr("3 of 3 frames have a recorded pose")));
  ASSERT_EQ(scan.world_from_frame.size(), 3u);
  EXPECT_TRUE(scan.world_from_frame[1].translation().isApprox(Vector3d(0, 0, -0.7)));
  fs::remove_all(session_);
  session = imported(of("bop", "naked"));
  EXPECT_EQ(session.naked.at("k1").depth_mm.at<std::uint16_t>(7, 7), 2000);
  EXPECT_EQ(session.calibration->sensors.at("k1").color->fx, 57.25);
}

TEST_F(ImportBop, EachImageHasItsOwnScale) {
  json file = cameras();
  file["3"]["depth_scale"] = 0.05;
  write("scene_camera.json", file.dump());
  const CaptureSession session = imported(of("bop"));
  EXPECT_EQ(session.scans.at("scan_user").depth_mm[1].at<std::uint16_t>(7, 7), 1002);  // 20030 / 20
  EXPECT_EQ(session.scans.at("scan_user").depth_mm[2].at<std::uint16_t>(7, 7), 2012);
}

TEST_F(ImportBop, Errors) {
  EXPECT_THAT(error_after([](json& f) { f.erase("12"); }), HasSubstr("scene_camera.json: 12: is missing"));
  EXPECT_THAT(error_after([](json& f) { f["3"]["cam_K"][0] = 60; }), HasSubstr("3.cam_K: found another camera"));
  EXPECT_THAT(error_after([](json& f) { f["0"]["depth_scale"] = -1; }), HasSubstr("0.depth_scale: found -1"));
  EXPECT_THAT(error_after([](json& f) {
                for (auto& each : f) each["cam_K"][4] = -57.4;
              }),
              HasSubstr("fy: found -57.4 px; expected a positive focal length"));
  EXPECT_THAT(error_after([](json& f) {
                for (auto& each : f) each["depth_scale"] = 1.0;
              }),
              HasSubstr("depth images: found depth of 20."));
  EXPECT_THAT(error_after([](json& f) { f["0"]["cam_K"] = "none"; }), HasSubstr("0.cam_K: found \"none\""));
  write("scene_camera.json", "[1, 2");
  EXPECT_THAT(error(of("bop")), HasSubstr("scene_camera.json: is not JSON"));
  EXPECT_THAT(error(of("bop", "boards")), HasSubstr("no infrared images"));
}

}  // namespace
}  // namespace dressform
