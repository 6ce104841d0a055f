#include <gmock/gmock.h>

#include <fstream>

#include "scenes/image_file.h"
#include "scenes/testing/session_folder.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

TEST_F(SessionFolder, RoundTrip) {
  const CaptureSession written = sample_session(), read = read_capture_session(folder_);
  EXPECT_EQ(read.name, written.name);
  EXPECT_EQ(read.created_by, written.created_by);
  EXPECT_EQ(read.licence, written.licence);
  EXPECT_EQ(read.sensors, written.sensors);
  for (const auto& name : read.sensors) {
    expect_same_shot(read.naked.at(name), written.naked.at(name));
    expect_same_shot(read.dressed.at(name), written.dressed.at(name));
    EXPECT_TRUE(read.prior->world_from_sensor.at(name).isApprox(written.prior->world_from_sensor.at(name), 1e-15));
  }
  ASSERT_EQ(read.calibration->sensors.size(), 3u);
  const auto &a = read.calibration->sensors.at("k1"), b = written.calibration->sensors.at("k1");
  EXPECT_EQ(a.model, b.model);
  EXPECT_EQ(a.ir.fy, b.ir.fy) << "numbers come back bit for bit";
  EXPECT_EQ(a.color->distortion, b.color->distortion);
  EXPECT_EQ(a.depth_offset_m, b.depth_offset_m);
  EXPECT_TRUE(a.color_from_ir.matrix() == b.color_from_ir.matrix());
  EXPECT_FALSE(read.calibration->sensors.at("handheld").color);
  EXPECT_EQ(read.scans.at("scan_user").depth_mm.size(), 2u);
  EXPECT_TRUE(same_image(read.scans.at("scan_user").depth_mm[1], written.scans.at("scan_user").depth_mm[1]));
  EXPECT_EQ(read.prior->rotation_sigma_deg, 5);
  EXPECT_FALSE(read.boards);
}

TEST_F(SessionFolder, JpegColour) {
  fs::remove(folder_ / "naked/k1/color.png");
  cv::imwrite((folder_ / "naked/k1/color.jpg").string(), cv::Mat(kSampleColor, CV_8UC3, cv::Scalar(200, 100, 50)));
  EXPECT_EQ(error(), "no error");
  const auto color = read_capture_session(folder_).naked["k1"].color;
  EXPECT_NEAR(color.at<cv::Vec3b>(9, 9)[0], 200, 4);
  fs::resize_file(folder_ / "naked/k1/color.jpg", fs::file_size(folder_ / "naked/k1/color.jpg") - 20);
  EXPECT_THAT(error(), HasSubstr("naked/k1/color.jpg: is damaged"));
  cv::imwrite((folder_ / "naked/k1/color.png").string(), color);
  EXPECT_THAT(error(), HasSubstr("color.png and color.jpg"));
}

TEST_F(SessionFolder, WriterRefusesAnExistingFolder) {
  EXPECT_THROW(write_capture_session(folder_, sample_session()), InputError);
  EXPECT_EQ(std::distance(fs::directory_iterator(root_), {}), 1) << "nothing is left behind";
}

TEST_F(SessionFolder, UnknownKeysAreLeftAlone) {
  EXPECT_EQ(error_after("session.json", [](json& file) { file["weather"] = "fine"; }), "no error");
}

TEST_F(SessionFolder, BoardsInsteadOfACalibration) {
  CaptureSession session = sample_session();
  session.calibration.reset();
  session.boards.emplace();
  session.boards->inner_corners_x = 11;
  session.boards->inner_corners_y = 19;
  session.boards->square_m = 0.028;
  for (const auto& name : session.sensors) {
    const Shot shot = sample_shot(50);
    session.boards->shots[name] = {{shot.color, shot.ir, shot.depth_mm}, {shot.color, shot.ir, shot.depth_mm}};
  }
  folder_ = root_ / "boards";
  write_capture_session(folder_, session);
  const CaptureSession read = read_capture_session(folder_);
  EXPECT_FALSE(read.calibration);
  ASSERT_TRUE(read.boards);
  EXPECT_EQ(read.boards->inner_corners_y, 19);
  EXPECT_TRUE(same_image(read.boards->shots.at("k2")[1].ir, session.boards->shots.at("k2")[1].ir));
  EXPECT_THAT(error_with_image("boards/k2/01_ir.png", noise_image(kSampleColor, CV_16UC1, 1)),
              HasSubstr("differs in size"));
  fs::remove(folder_ / "boards/k1/00_depth.png");
  EXPECT_THAT(error(), HasSubstr("boards/k1/00_depth.png: is missing"));
}

TEST_F(SessionFolder, InfraredIsOptional) {
  fs::remove(folder_ / "naked/k1/ir.png");
  CaptureSession session = read_capture_session(folder_);
  EXPECT_TRUE(session.naked.at("k1").ir.empty());
  EXPECT_FALSE(session.naked.at("k2").ir.empty());
  folder_ = root_ / "without";
  write_capture_session(folder_, session);
  EXPECT_FALSE(fs::exists(folder_ / "naked/k1/ir.png"));
  EXPECT_TRUE(read_capture_session(folder_).naked.at("k1").ir.empty());
}

TEST_F(SessionFolder, ContentHash) {
  const std::string before = session_content_hash(folder_);
  EXPECT_EQ(session_content_hash(folder_), before);
  fs::create_directories(folder_ / "truth");
  std::ofstream(folder_ / "truth/scene.toml") << "x";
  EXPECT_EQ(session_content_hash(folder_), before) << "the truth does not count";
  write_capture_session(root_ / "other", sample_session());
  EXPECT_EQ(session_content_hash(root_ / "other"), before) << "nor where the session lies";
  fs::rename(folder_ / "scan_user/0001_depth.png", folder_ / "scan_user/0002_depth.png");
  EXPECT_NE(session_content_hash(folder_), before);
  fs::rename(folder_ / "scan_user/0002_depth.png", folder_ / "scan_user/0001_depth.png");
  EXPECT_EQ(session_content_hash(folder_), before);
  std::ofstream(folder_ / "session.json", std::ios::app) << "\n";
  EXPECT_NE(session_content_hash(folder_), before);
}

}  // namespace
}  // namespace dressform
