#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "scenes/capture_session.h"
#include "scenes/error.h"

namespace dressform {

// A small session with all that a session may have, and its folder for tests that change its files.

inline const cv::Size kSampleGrid(32, 26), kSampleColor(64, 36);

inline cv::Mat noise_image(cv::Size size, int type, int stream) {
  cv::Mat image(size, type);
  cv::RNG generator(static_cast<std::uint64_t>(stream) + 1);
  generator.fill(image, cv::RNG::UNIFORM, 0, CV_MAT_DEPTH(type) == CV_16U ? 65536 : 256);
  return image;
}

// Depth of a room, with holes.
inline cv::Mat sample_depth(int stream) {
  cv::Mat depth(kSampleGrid, CV_16UC1);
  cv::RNG(static_cast<std::uint64_t>(stream) + 1).fill(depth, cv::RNG::UNIFORM, 500, 4500);
  depth.row(0).setTo(0);
  return depth;
}

inline Shot sample_shot(int stream) {
  Shot shot;
  shot.color = noise_image(kSampleColor, CV_8UC3, stream);
  shot.depth_mm = sample_depth(stream + 100);
  shot.ir = noise_image(kSampleGrid, CV_16UC1, stream + 200);
  return shot;
}

inline SensorCalibration sample_calibration() {
  SensorCalibration sensor;
  sensor.model = "kinect_v2";
  sensor.color = Camera{kSampleColor.width, kSampleColor.height, 30.1, 30.2, 31.5, 17.9, {0.1, -0.2, 1e-3, 2e-3, 0.03}};
  sensor.ir = Camera{kSampleGrid.width, kSampleGrid.height, 20.1, 1.0 / 3 + 20, 16, 13, {0.05, 0, 0, 0, 0}};
  sensor.color_from_ir = Eigen::Translation3d(0.05, 0, 0.001) * Eigen::AngleAxisd(0.01, Vector3d(1, 2, 3).normalized());
  sensor.depth_offset_m = -0.0133;
  return sensor;
}

inline CaptureSession sample_session() {
  CaptureSession session;
  session.name = "sample";
  session.created_by = "test";
  session.licence = "CC0-1.0";
  session.sensors = {"k1", "k2"};
  session.calibration.emplace();
  int stream = 0;
  for (const auto& name : session.sensors) {
    session.calibration->sensors[name] = sample_calibration();
    session.naked[name] = sample_shot(++stream);
    session.dressed[name] = sample_shot(++stream);
  }
  session.dressed["k1"].body_index = noise_image(kSampleGrid, CV_8UC1, 7);
  session.dressed["k1"].skeleton = Skeleton{{"Head", {Vector3d(0.1, 1.0 / 3, 2), true}}, {"Neck", {}}};
  auto handheld = sample_calibration();
  handheld.color.reset();
  handheld.color_from_ir = Isometry3d::Identity();
  session.calibration->sensors["handheld"] = handheld;
  for (const char* name : {"scan_naked", "scan_user"})
    session.scans[name] = {"handheld", {sample_depth(300), sample_depth(301)}};
  session.prior.emplace();
  for (const auto& name : session.sensors)
    session.prior->world_from_sensor[name] = sample_calibration().color_from_ir * Eigen::Translation3d(1, 2, 3);
  return session;
}

inline bool same_image(const cv::Mat& a, const cv::Mat& b) {
  if (a.empty() || b.empty()) return a.empty() && b.empty();
  return a.type() == b.type() && a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

inline void expect_same_shot(const Shot& a, const Shot& b) {
  EXPECT_TRUE(same_image(a.color, b.color));
  EXPECT_TRUE(same_image(a.depth_mm, b.depth_mm));
  EXPECT_TRUE(same_image(a.ir, b.ir));
  EXPECT_TRUE(same_image(a.body_index, b.body_index));
  ASSERT_EQ(a.skeleton.has_value(), b.skeleton.has_value());
  if (!a.skeleton) return;
  ASSERT_EQ(a.skeleton->size(), b.skeleton->size());
  for (const auto& [name, joint] : *a.skeleton) {
    EXPECT_EQ(joint.position, b.skeleton->at(name).position);
    EXPECT_EQ(joint.tracked, b.skeleton->at(name).tracked);
  }
}

class SessionFolder : public testing::Test {
 protected:
  void SetUp() override {
    root_ = std::filesystem::path(testing::TempDir()) / ("session_" + std::string(test_name()));
    std::filesystem::remove_all(root_);
    std::filesystem::create_directories(root_);
    folder_ = root_ / "sample";
    write_capture_session(folder_, sample_session());
  }
  void TearDown() override { std::filesystem::remove_all(root_); }
  static const char* test_name() { return testing::UnitTest::GetInstance()->current_test_info()->name(); }

  std::string error() const {
    try {
      read_capture_session(folder_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  nlohmann::json load(const std::string& name) const { return nlohmann::json::parse(std::ifstream(folder_ / name)); }
  void store(const std::string& name, const nlohmann::json& value) const { std::ofstream(folder_ / name) << value; }
  // The error after one change of a JSON file, which is then undone.
  template <class Change>
  std::string error_after(const std::string& name, Change change) const {
    const nlohmann::json before = load(name);
    nlohmann::json after = before;
    change(after);
    store(name, after);
    const std::string text = error();
    store(name, before);
    return text;
  }
  std::string error_with_image(const std::string& name, const cv::Mat& image) const {
    const std::filesystem::path kept = root_ / "kept.png";
    std::filesystem::copy_file(folder_ / name, kept, std::filesystem::copy_options::overwrite_existing);
    cv::imwrite((folder_ / name).string(), image);
    const std::string text = error();
    std::filesystem::copy_file(kept, folder_ / name, std::filesystem::copy_options::overwrite_existing);
    return text;
  }
  std::filesystem::path root_, folder_;
};

}  // namespace dressform
