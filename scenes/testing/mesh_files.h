#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <string>

#include "scenes/error.h"
#include "scenes/mesh.h"

namespace dressform {

// A folder for one test, gone afterwards, and files in it.
class FilesTest : public testing::Test {
 protected:
  FilesTest() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("dressform_") + test->test_suite_name() + "_" + test->name() + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~FilesTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  std::filesystem::path text(const std::string& name, const std::string& content) const {
    std::filesystem::create_directories(file(name).parent_path());
    std::ofstream(file(name), std::ios::binary) << content;
    return file(name);
  }
  // What the InputError that `act` throws says; empty when it throws none.
  template <class Act>
  static std::string refusal(const Act& act) {
    try {
      act();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

// Red in its top left corner, green in its top right, otherwise blue.
inline cv::Mat marked_image() {
  cv::Mat image(8, 16, CV_8UC3, cv::Scalar(255, 0, 0));
  image(cv::Rect(0, 0, 4, 4)).setTo(cv::Scalar(0, 0, 255));
  image(cv::Rect(12, 0, 4, 4)).setTo(cv::Scalar(0, 255, 0));
  return image;
}

// A tube about y with one texture seam from rim to rim: u round it, v down it.
inline TexturedMesh tube(int around = 12, int rows = 4) {
  TexturedMesh result;
  for (int row = 0; row <= rows; ++row)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * M_PI * i / around;
      result.mesh.vertices.emplace_back(std::sin(angle) / 3, 1 - 0.1 * row / 3, std::cos(angle) / 3);
    }
  const auto uv = [&](int row, int i) { return Vector2f(float(i) / float(around), float(row) / float(rows)); };
  for (int row = 0; row < rows; ++row)
    for (int i = 0; i < around; ++i) {
      const int a = row * around + i, b = row * around + (i + 1) % around;
      result.mesh.triangles.emplace_back(a, a + around, b + around);
      result.corner_uv.push_back({uv(row, i), uv(row + 1, i), uv(row + 1, i + 1)});
      result.mesh.triangles.emplace_back(a, b + around, b);
      result.corner_uv.push_back({uv(row, i), uv(row + 1, i + 1), uv(row, i + 1)});
    }
  result.texture = marked_image();
  return result;
}

// A GLB of a JSON text and its binary chunk.
inline std::string glb_of(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto word = [](std::size_t value) {
    const auto narrow = static_cast<std::uint32_t>(value);
    return std::string(reinterpret_cast<const char*>(&narrow), 4);
  };
  return "glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) + "JSON" + json +
         word(binary.size()) + std::string("BIN\0", 4) + binary;
}

}  // namespace dressform
