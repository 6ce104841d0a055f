#include "render/turntable.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "scenes/file_bytes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// A flat sign in the plane z = 0: seen whole from the front, on edge from the side.
Mesh flat_sign() {
  Mesh mesh;
  mesh.vertices = {{-0.5, 0, 0}, {0.5, 0, 0}, {0.5, 1, 0}, {-0.5, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

int drawn(const cv::Mat& image) {
  cv::Mat background;
  cv::inRange(image, cv::Scalar::all(255), cv::Scalar::all(255), background);
  return static_cast<int>(image.total()) - cv::countNonZero(background);
}

TEST(Turntable, GoesRoundOnce) {
  Renderer renderer;
  const Mesh mesh = flat_sign();
  RenderItem item;
  item.mesh = &mesh;
  TurntableOptions options;
  options.frames = 4, options.height_px = 64, options.elevation_deg = 0;
  const auto frames = turntable_frames(renderer, {item}, options);
  ASSERT_EQ(frames.size(), 4u);
  EXPECT_EQ(frames[0].cols % 2, 0);
  EXPECT_GT(drawn(frames[0]), 20 * drawn(frames[1]));
  EXPECT_NEAR(drawn(frames[0]), drawn(frames[2]), 0.02 * drawn(frames[0]));
  EXPECT_THROW(turntable_frames(renderer, {}, options), std::invalid_argument);
}

std::vector<cv::Mat> two_frames() {
  return {cv::Mat(32, 32, CV_8UC3, cv::Scalar::all(10)), cv::Mat(32, 32, CV_8UC3, cv::Scalar::all(240))};
}

TEST(Turntable, WithoutAnEndingThereAreFrames) {
  const fs::path folder = fs::path(testing::TempDir()) / "turn";
  fs::remove_all(folder);
  EXPECT_EQ(write_animation(two_frames(), 24, folder), folder);
  EXPECT_TRUE(fs::exists(folder / "frame_000.png"));
  EXPECT_TRUE(fs::exists(folder / "frame_001.png"));
  EXPECT_FALSE(fs::exists(folder / "frame_002.png"));
}

TEST(Turntable, TheSameFramesGiveTheSameAnimation) {
  if (!has_ffmpeg()) GTEST_SKIP() << "no ffmpeg here";
  const fs::path folder = testing::TempDir();
  for (const char* name : {"a.mp4", "b.mp4"}) write_animation(two_frames(), 24, folder / name);
  const std::string bytes = read_file_bytes(folder / "a.mp4");
  EXPECT_EQ(bytes, read_file_bytes(folder / "b.mp4"));
  EXPECT_NE(bytes.find("ftyp"), std::string::npos);
}

}  // namespace
}  // namespace dressform
