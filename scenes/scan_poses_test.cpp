#include "scenes/scan_poses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "scenes/capture_session.h"
#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

class ScanPoses : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) / "scan_poses";
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const std::string& poses) const {
    std::ofstream(folder_ / "poses.json")
        << R"({"format": "dressform-scan-poses", "version": 1, "world_from_frame": )" << poses << "}";
  }
  auto reading() const {
    return [this] { read_scan_poses(folder_ / "poses.json", 3); };
  }
  fs::path folder_;
};

std::vector<Isometry3d> some_poses() {
  std::vector<Isometry3d> poses(3, no_pose());
  poses[0] = Eigen::Translation3d(0.1, 1.0 / 3, -2) * Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized());
  poses[2] = Isometry3d::Identity();
  return poses;
}

TEST_F(ScanPoses, RoundTripWithAFrameThatHasNone) {
  const auto poses = some_poses();
  write_scan_poses(folder_ / "poses.json", poses);
  const auto read = read_scan_poses(folder_ / "poses.json", 3);
  ASSERT_EQ(read.size(), 3u);
  EXPECT_TRUE(read[0].isApprox(poses[0], 1e-12));
  EXPECT_FALSE(read[1].matrix().allFinite());
  EXPECT_TRUE(read[2].isApprox(poses[2]));
}

TEST_F(ScanPoses, ErrorsNameTheFrame) {
  write(R"({"0003": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]})");
  EXPECT_THAT(reading(), ThrowsMessage<InputError>(HasSubstr("found frame \"0003\"; expected \"0000\" to \"0002\"")));
  write(R"({"first": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]})");
  EXPECT_THAT(reading(), ThrowsMessage<InputError>(HasSubstr("found frame \"first\"")));
  write(R"({"0001": [[1,0,0,0],[0,2,0,0],[0,0,1,0],[0,0,0,1]]})");
  EXPECT_THAT(reading(), ThrowsMessage<InputError>(HasSubstr("world_from_frame.0001: found a matrix that is no")));
  write("[]");
  EXPECT_THAT(reading(), ThrowsMessage<InputError>(HasSubstr("expected an object")));
}

// A session keeps them with the scan, and they count for its content.
TEST_F(ScanPoses, AreKeptInTheSession) {
  CaptureSession session;
  session.name = "posed";
  session.sensors = {"handheld"};
  session.calibration.emplace();
  session.calibration->sensors["handheld"].ir = Camera{32, 26, 20, 20, 16, 13, {}};
  session.scans["scan_naked"] = {"handheld", std::vector<cv::Mat>(3, cv::Mat(26, 32, CV_16U, cv::Scalar(2000)))};
  write_capture_session(folder_ / "without", session);
  EXPECT_TRUE(read_capture_session(folder_ / "without").scans.at("scan_naked").world_from_frame.empty());
  session.scans["scan_naked"].world_from_frame = some_poses();
  write_capture_session(folder_ / "with", session);
  const auto read = read_capture_session(folder_ / "with").scans.at("scan_naked").world_from_frame;
  ASSERT_EQ(read.size(), 3u);
  EXPECT_TRUE(read[0].isApprox(some_poses()[0], 1e-12));
  EXPECT_NE(session_content_hash(folder_ / "with"), session_content_hash(folder_ / "without"));
}

}  // namespace
}  // namespace dressform
