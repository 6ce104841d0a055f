#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <opencv2/core.hpp>

#include "scenes/file_bytes.h"
#include "scenes/image_file.h"
#include "scenes/json_file.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// `dressform segment` as its users call it.
class SegmentCommand : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(testing::TempDir()) / "segment_command";
    fs::remove_all(root_);
    fs::create_directories(root_);
    write_png(root_ / "two.png", two_halves(CV_8UC3));
  }
  void TearDown() override { fs::remove_all(root_); }

  // Left half dark, right half light; 60 x 80.
  static cv::Mat two_halves(int type) {
    cv::Mat image(60, 80, type, cv::Scalar::all(CV_MAT_DEPTH(type) == CV_16U ? 6000 : 40));
    image.colRange(40, 80).setTo(cv::Scalar::all(CV_MAT_DEPTH(type) == CV_16U ? 52000 : 210));
    return image;
  }

  int run(const std::string& arguments) const {
    const std::string command =
        std::string(DRESSFORM_PROGRAM) + " segment " + arguments + " > " + path("out") + " 2> " + path("err");
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string path(const std::string& name) const { return (root_ / name).string(); }
  cv::Mat labels(const std::string& name) const { return read_image(root_ / name, kDepthImage); }

  fs::path root_;
};

TEST_F(SegmentCommand, WritesAFolderOfEveryStep) {
  ASSERT_EQ(run(path("two.png") + " -o " + path("a")), 0) << read_file_bytes(root_ / "err");
  for (const char* name : {"regions", "overlay", "unmerged", "classes", "class_map", "j_scale1", "valleys"})
    EXPECT_TRUE(fs::exists(root_ / "a" / (std::string(name) + ".png"))) << name;
  const cv::Mat map = labels("a/regions.png");
  EXPECT_EQ(map.at<std::uint16_t>(30, 5), 1);
  EXPECT_EQ(map.at<std::uint16_t>(30, 75), 2);
  const JsonValue json = read_json(root_ / "a/regions.json", "dressform-jseg", 1);
  ASSERT_EQ(json.at("regions").elements().size(), 2u);
  EXPECT_EQ(json.at("regions").elements()[1].at("mean_rgb").numbers(3)[0], 210);
  EXPECT_THAT(read_file_bytes(root_ / "out"), HasSubstr("2 colour classes"));
}

TEST_F(SegmentCommand, WritesAPngAndTheRestBesideItTheSameForOneAndTwoThreads) {
  ASSERT_EQ(run(path("two.png") + " -o " + path("one.png") + " --threads 1 --merge 0.3 --scales 1"), 0);
  ASSERT_EQ(run(path("two.png") + " -o " + path("two_threads.png") + " --threads 2 --merge 0.3 --scales 1"), 0);
  for (const char* name : {".png", "_overlay.png", "_j_scale1.png", "_class_map.png", ".json"})
    EXPECT_EQ(read_file_bytes(path("one") + name), read_file_bytes(path("two_threads") + name)) << name;
}

TEST_F(SegmentCommand, TakesGreySixteenBitsTransparencyAndMasks) {
  write_png(root_ / "grey.png", two_halves(CV_8UC1));
  write_png(root_ / "deep.png", two_halves(CV_16UC3));
  cv::Mat clear = two_halves(CV_8UC4), mask(60, 80, CV_8U, cv::Scalar(255));
  clear.setTo(cv::Scalar(0, 0, 0, 0));
  two_halves(CV_8UC4).colRange(20, 80).copyTo(clear.colRange(20, 80));
  clear.colRange(20, 80).forEach<cv::Vec4b>([](cv::Vec4b& pixel, const int*) { pixel[3] = 255; });
  write_png(root_ / "clear.png", clear);
  mask.rowRange(50, 60).setTo(0);
  write_png(root_ / "mask.png", mask);
  for (const char* name : {"grey", "deep"}) {
    ASSERT_EQ(run(path(name) + ".png -o " + path(name)), 0) << read_file_bytes(root_ / "err");
    EXPECT_EQ(labels(std::string(name) + "/regions.png").at<std::uint16_t>(30, 75), 2) << name;
  }
  ASSERT_EQ(run(path("clear.png") + " --mask " + path("mask.png") + " -o " + path("clear")), 0);
  const cv::Mat map = labels("clear/regions.png");
  EXPECT_EQ(map.at<std::uint16_t>(30, 5), 0);
  EXPECT_EQ(map.at<std::uint16_t>(55, 75), 0);
  EXPECT_EQ(map.at<std::uint16_t>(30, 30), 1);
  EXPECT_EQ(map.at<std::uint16_t>(30, 75), 2);
}

TEST_F(SegmentCommand, WhatIsWrongIsOneLineAndCodeTwo) {
  write_file_atomically(root_ / "text.png", "no image");
  const std::string bytes = read_file_bytes(root_ / "two.png");
  write_file_atomically(root_ / "cut.png", bytes.substr(0, bytes.size() / 2));
  write_png(root_ / "small.png", cv::Mat(10, 10, CV_8U, cv::Scalar(255)));
  write_png(root_ / "black.png", cv::Mat::zeros(60, 80, CV_8U));
  write_png(root_ / "large.png", cv::Mat::zeros(5900, 5900, CV_8U));
  const std::string image = path("two.png"), out = " -o " + path("x");
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {path("missing.png") + out, "missing.png"},
      {path("text.png") + out, "text.png"},
      {path("cut.png") + out, "cut.png"},
      {path("large.png") + out, "5900 x 5900"},
      {image + " --mask " + path("small.png") + out, "small.png"},
      {image + " --mask " + path("black.png") + out, "leaves no pixel"},
      {image + " -o " + image, "exists already"},
      {image + " --scales 5" + out, "scales"},
      {image + " --merge -1" + out, "merge"},
      {image + " --classes 300" + out, "classes"},
      {image, "output"}};
  for (const auto& [arguments, says] : wrong) {
    EXPECT_EQ(run(arguments), 2) << arguments;
    std::string error = read_file_bytes(root_ / "err");
    const std::string hint = "Run with --help for more information.\n";  // after what the command line itself refuses
    if (const auto at = error.find(hint); at != std::string::npos) error.erase(at, hint.size());
    EXPECT_THAT(error, HasSubstr(says)) << arguments;
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
    EXPECT_FALSE(fs::exists(root_ / "x")) << arguments;
  }
}

}  // namespace
}  // namespace dressform
