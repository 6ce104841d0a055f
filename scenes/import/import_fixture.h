#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "scenes/error.h"
#include "scenes/import/import.h"

namespace dressform {

// A fresh folder for every test, with a recording that the test writes and the session made of it.
class Import : public testing::Test {
 protected:
  void SetUp() override {
    root_ = std::filesystem::path(testing::TempDir()) /
            ("import_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(root_);
    std::filesystem::create_directories(recording_ = root_ / "recording");
    session_ = root_ / "session";
  }
  void TearDown() override { std::filesystem::remove_all(root_); }

  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((recording_ / name).parent_path());
    std::ofstream(recording_ / name) << text;
  }
  void image(const std::string& name, const cv::Mat& image) const {
    std::filesystem::create_directories((recording_ / name).parent_path());
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
      for (const auto& entry : std::filesystem::directory_iterator(root_))
        EXPECT_THAT((std::vector<std::filesystem::path>{recording_, root_ / "with"}), testing::Contains(entry.path()));
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.what();
    }
    return "no error";
  }

  std::filesystem::path root_, recording_, session_;
  ImportReport report_;
};

inline ImportRequest of(const std::string& format, const std::string& role = {}) {
  ImportRequest request;
  request.format = format;
  request.role = role;
  return request;
}

inline cv::Mat ramp(cv::Size size, int from, int step) {
  cv::Mat image(size, CV_16UC1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      image.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(from + step * (x + size.width * y));
  return image;
}

}  // namespace dressform
