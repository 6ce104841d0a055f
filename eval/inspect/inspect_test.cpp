#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <opencv2/core.hpp>

#include "eval/inspect/inspect_session.h"
#include "eval/inspect/sensor_charts.h"
#include "eval/testing/noisy_plane.h"
#include "scenes/error.h"
#include "scenes/file_bytes.h"
#include "scenes/hash.h"
#include "synthetic/sensors/known_scenes.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

// Everything that the figures of the sensor models are asked for, judged, in one look.
TEST(InspectSensor, EveryFigureOfKinectV2IsWithinItsTolerance) {
  const Inspection inspection = inspect_sensor("kinect_v2", {}, [](const std::string&, int, int) {});
  std::string names;
  for (const auto& section : inspection.sections) {
    ASSERT_EQ(section.charts.size(), 1u) << section.title;
    for (const auto& finding : section.findings) {
      names += finding.what + "\n";
      EXPECT_TRUE(finding.judged()) << finding.what;
      EXPECT_TRUE(finding.good()) << finding.what << " " << finding.measured;
    }
  }
  for (const char* what : {"sigma at 1 m", "sigma at 4 m", "sigma at 2 m and 80 degrees", "decoding error",
                           "holes at 75", "flying pixels at a gap of 2.1 m", "autocorrelation at lag 3", "wiggling"})
    EXPECT_THAT(names, HasSubstr(what));
  EXPECT_GE(count_of(inspection).judged, 30);
}

TEST(InspectSensor, TheLadderOfKinectV1) {
  const InspectionSection section = levels({"kinect_v1", {}, usual_camera("kinect_v1")});
  ASSERT_EQ(section.findings.size(), 2u);
  for (const auto& finding : section.findings) {
    EXPECT_EQ(finding.measured, 259);
    EXPECT_TRUE(finding.good());
  }
}

TEST(InspectSensor, AFigureOutsideItsToleranceIsSaidToBe) {
  const SensorSetup loud{"kinect_v2", {{"noise_scale", 3.0}}, usual_camera("kinect_v2")};
  bool outside = false;
  for (const auto& finding : sigma_by_distance(loud).findings) outside = outside || !finding.good();
  EXPECT_TRUE(outside);
  EXPECT_THROW(inspect_sensor("sonar", {}, {}), InputError);
  EXPECT_THROW(inspect_sensor("kinect_v2", {{"loudness", 1.0}}, {}), InputError);
}

// ---- sessions

CaptureSession some_session() {
  CaptureSession session;
  session.name = "sample <1>";
  session.sensors = {"k1", "k2"};
  session.calibration.emplace();
  session.prior.emplace();
  SensorCalibration sensor;
  sensor.model = "kinect_v2";
  sensor.ir = half_size_kinect();
  sensor.color = Camera{192, 108, 100, 100, 95.5, 53.5, {}};
  for (const auto& name : session.sensors) {
    session.calibration->sensors[name] = sensor;
    session.prior->world_from_sensor[name] =
        Eigen::Translation3d(name == "k1" ? 0 : 1, 1.2, 2) * Eigen::AngleAxisd(M_PI, Vector3d::UnitX());
    for (auto* shots : {&session.naked, &session.dressed})
      (*shots)[name] = {cv::Mat(108, 192, CV_8UC3, cv::Scalar(60, 120, 180)),
                        noisy_plane(2, 15, 3, shots == &session.naked ? 1 : 2),
                        cv::Mat(212, 256, CV_16UC1, cv::Scalar(900)),
                        cv::Mat(),
                        {}};
  }
  session.dressed["k1"].body_index = cv::Mat(212, 256, CV_8UC1, cv::Scalar(255));
  sensor.color.reset();
  session.calibration->sensors["handheld"] = sensor;
  session.scans["scan_user"].sensor = "handheld";
  for (int i = 0; i < 7; ++i) session.scans["scan_user"].depth_mm.push_back(noisy_plane(2.2, 5, 2, 30 + i));
  return session;
}

class InspectFolder : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(testing::TempDir()) /
            ("inspect_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  void TearDown() override { fs::remove_all(root_); }
  static Inspection inspect(const CaptureSession& session) {
    return inspect_session(session, [](const std::string&, int, int) {});
  }
  std::map<std::string, std::string> hashes(const fs::path& folder) const {
    std::map<std::string, std::string> result;
    for (const auto& entry : fs::directory_iterator(folder))
      result[entry.path().filename().string()] = hash_file(entry.path());
    return result;
  }
  int run(const std::string& arguments) const {
    const std::string command = std::string(DRESSFORM_PROGRAM) + " " + arguments + " > " + (root_ / "out").string() +
                                " 2> " + (root_ / "err").string();
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  fs::path root_;
};

TEST_F(InspectFolder, EveryStreamIsThereAndTheSameForOneAndTwoThreads) {
  const CaptureSession session = some_session();
  for (int threads = 1; threads <= 2; ++threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    write_inspection(inspect(session), root_ / std::to_string(threads));
  }
  const auto files = hashes(root_ / "1");
  EXPECT_EQ(files, hashes(root_ / "2"));
  for (const char* name : {"inspect.html", "statistics.json", "naked_color.png", "naked_depth.png", "dressed_ir.png",
                           "dressed_body_index.png", "scan_user.png", "points_by_sensor.png", "points_as_seen.png",
                           "noise_distance_kinect_v2.png", "noise_distance_kinect_v2.svg", "noise_angle_kinect_v2.png"})
    EXPECT_EQ(files.count(name), 1u) << name;
  const std::string html = read_file_bytes(root_ / "1/inspect.html");
  EXPECT_THAT(html, HasSubstr("Session sample &lt;1&gt;"));
  EXPECT_THAT(html, Not(HasSubstr("src=\"http")));
}

TEST_F(InspectFolder, NoiseIsThatOfTheFrames) {
  std::map<std::string, Finding> found;
  for (const auto& section : inspect(some_session()).sections)
    for (const auto& finding : section.findings) found.emplace(finding.what, finding);
  ASSERT_TRUE(found.count("sigma from pixel to pixel, 2.0 to 2.5 m"));
  ASSERT_TRUE(found.count("sigma from frame to frame, 2.0 to 2.5 m"));
  EXPECT_NEAR(found.at("sigma from pixel to pixel, 2.0 to 2.5 m").measured, 2.6, 0.6);  // of 2 and 3 mm
  EXPECT_NEAR(found.at("sigma from frame to frame, 2.0 to 2.5 m").measured, 2.6, 0.6);
  EXPECT_NEAR(found.at("autocorrelation at lag 1").measured, 0, 0.05);
}

TEST_F(InspectFolder, BoardsAloneAndEmptyDepth) {
  CaptureSession session;
  session.name = "boards";
  session.sensors = {"k1"};
  session.boards.emplace();
  session.boards->inner_corners_x = 5, session.boards->inner_corners_y = 7, session.boards->square_m = 0.03;
  for (int i = 0; i < 9; ++i)
    session.boards->shots["k1"].push_back({cv::Mat(108, 192, CV_8UC3, cv::Scalar::all(9)),
                                           cv::Mat(212, 256, CV_16UC1, cv::Scalar(1)),
                                           cv::Mat::zeros(212, 256, CV_16UC1)});
  write_inspection(inspect(session), root_ / "a");
  EXPECT_TRUE(fs::exists(root_ / "a/boards_k1_depth.png"));
  session.boards->shots["k1"][0].depth_mm.at<std::uint16_t>(6, 6) = 1000;  // one lone point
  write_inspection(inspect(session), root_ / "b");
  EXPECT_TRUE(fs::exists(root_ / "b/points_k1.png"));
  EXPECT_THROW(write_inspection(Inspection{}, root_ / "b"), InputError);
}

TEST_F(InspectFolder, ASessionOfAScanAlone) {
  CaptureSession session = some_session();
  session.naked.clear(), session.dressed.clear(), session.prior.reset();
  session.sensors = {"handheld"};
  const Inspection inspection = inspect(session);
  std::string text;
  for (const auto& section : inspection.sections)
    for (const auto& line : section.text) text += line;
  EXPECT_THAT(text, HasSubstr("7 frames of views that were taken more than once"));
}

TEST_F(InspectFolder, ErrorsOfTheCommandsAreOneLineAndCodeTwo) {
  const std::string out = (root_ / "x").string();
  for (const std::string& arguments : std::vector<std::string>{
           "inspect", "inspect " + root_.string() + " -o " + out,
           "inspect --sensor kinect_v2 --set sensor.loudness=1 -o " + out,
           "inspect --sensor ideal -o " + root_.string(), "import tum " + root_.string() + " -o " + out,
           "import redwood " + root_.string() + " -o " + out, "import iai_kinect2 " + root_.string() + " -o " + out,
           "import tum " + root_.string() + " --camera 1,2,3 -o " + out,
           "import iai_kinect2 " + root_.string() + " --board 5x7 -o " + out,
           "import iai_kinect2 " + root_.string() + " --place 1,2 -o " + out}) {
    EXPECT_EQ(run(arguments), 2) << arguments;
    const std::string error = read_file_bytes(root_ / "err");
    EXPECT_THAT(error, testing::StartsWith("error: ")) << arguments;
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
    EXPECT_FALSE(fs::exists(out)) << arguments;
  }
}

}  // namespace
}  // namespace dressform
