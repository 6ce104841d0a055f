#include <gmock/gmock.h>

#include "scenes/image_file.h"
#include "scenes/testing/session_folder.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

TEST_F(SessionFolder, DepthThatIsNone) {
  cv::Mat depth = sample_depth(1);
  depth.at<std::uint16_t>(9, 9) = 65535;
  EXPECT_THAT(
      error_with_image("naked/k1/depth.png", depth),
      HasSubstr("naked/k1/depth.png: found 65535 (0xFFFF) in 1 of 832 pixels, 65.5 m if it were depth, which is "
                "what recorders write where there is no depth; expected millimetres, and 0 for none"));
  EXPECT_THAT(error_with_image("scan_user/0001_depth.png", depth), HasSubstr("scan_user/0001_depth.png: found 65535"));
  EXPECT_THAT(error_with_image("dressed/k2/depth.png", cv::Mat::zeros(kSampleGrid, CV_16UC1)),
              HasSubstr("dressed/k2/depth.png: found no pixel with depth"));
  EXPECT_EQ(error_with_image("scan_user/0001_depth.png", cv::Mat::zeros(kSampleGrid, CV_16UC1)), "no error")
      << "a frame may be lost, a scan may not";
  cv::imwrite((folder_ / "scan_user/0000_depth.png").string(), cv::Mat::zeros(kSampleGrid, CV_16UC1));
  EXPECT_THAT(error_with_image("scan_user/0001_depth.png", cv::Mat::zeros(kSampleGrid, CV_16UC1)),
              HasSubstr("scan_user: found no pixel with depth"));
}

TEST_F(SessionFolder, DepthInAnotherUnit) {
  EXPECT_THAT(error_with_image("naked/k1/depth.png", sample_depth(1) / 10),
              HasSubstr("naked/k1/depth.png: found depth of 0.2"));
  EXPECT_THAT(error_with_image("naked/k1/depth.png", sample_depth(1) / 10),
              HasSubstr("(looks like centimetres, 100 a metre)"));
  EXPECT_THAT(error_with_image("dressed/k1/depth.png", sample_depth(1) * 5), HasSubstr("(looks like 5000 a metre)"));
}

TEST_F(SessionFolder, PriorsThatNoRigHas) {
  const auto at = [&](double azimuth_rad) {
    Isometry3d pose = Isometry3d::Identity();  // 2.1 m away, 1.25 m high, looking at the axis, a little down
    pose.linear() =
        (Eigen::AngleAxisd(azimuth_rad, Vector3d::UnitY()) * Eigen::AngleAxisd(M_PI + 0.05, Vector3d::UnitX()))
            .toRotationMatrix();
    pose.translation() = Vector3d(2.1 * std::sin(azimuth_rad), 1.25, 2.1 * std::cos(azimuth_rad));
    return pose;
  };
  const auto after = [&](auto change) {
    return error_after("session.json", [&](json& f) {
      for (const auto& [name, azimuth] : {std::pair("k1", 0.1), {"k2", 1.6}}) {
        const Isometry3d pose = change(at(azimuth));
        auto& rows = f["world_from_sensor_prior"][name] = json::array();
        for (int i = 0; i < 4; ++i)
          rows.push_back({pose.matrix()(i, 0), pose.matrix()(i, 1), pose.matrix()(i, 2), pose.matrix()(i, 3)});
      }
    });
  };
  const auto scaled = [](double by) {
    return [by](Isometry3d pose) {
      pose.translation() *= by;
      return pose;
    };
  };
  EXPECT_EQ(after([](const Isometry3d& pose) { return pose; }), "no error");
  EXPECT_THAT(after(scaled(1000)),
              HasSubstr("world_from_sensor_prior.k1: found a sensor at (209.65, 1250, 2089.51) m"));
  EXPECT_THAT(after(scaled(1000)), HasSubstr("looks like millimetres"));
  EXPECT_THAT(after(scaled(100)), HasSubstr("looks like centimetres"));
  EXPECT_THAT(after(scaled(39.37)), HasSubstr("looks like inches"));
  EXPECT_THAT(after([](const Isometry3d& pose) { return Isometry3d(pose.inverse()); }),
              HasSubstr("world_from_sensor_prior: found 1 of 2 sensors that look at the mannequin"));
  EXPECT_THAT(after([](const Isometry3d& pose) { return Isometry3d(pose.inverse()); }), HasSubstr("the inverse"));
  EXPECT_THAT(
      after([](const Isometry3d& pose) { return Isometry3d(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()) * pose); }),
      HasSubstr("a world with z up"));
  EXPECT_THAT(
      after([](const Isometry3d& pose) { return Isometry3d(pose * Eigen::AngleAxisd(M_PI, Vector3d::UnitX())); }),
      HasSubstr("y up and z backwards"));
  EXPECT_THAT(error_after("session.json", [](json& f) { f["prior_sigma"]["translation_m"] = 80; }),
              HasSubstr("found a sigma of 80 m (prior_sigma.translation_m)"));
}

TEST_F(SessionFolder, ManyBoardShots) {
  CaptureSession session = sample_session();
  session.boards.emplace();
  session.boards->inner_corners_x = 11, session.boards->inner_corners_y = 19, session.boards->square_m = 0.028;
  const Shot shot = sample_shot(50);
  for (const auto& name : session.sensors)
    session.boards->shots[name].assign(102, BoardShot{shot.color, shot.ir, shot.depth_mm});
  folder_ = root_ / "many";
  write_capture_session(folder_, session);
  EXPECT_EQ(read_capture_session(folder_).boards->shots.at("k2").size(), 102u);
  const auto with_square = [&](double square_m) {
    return error_after("session.json", [&](json& f) { f["boards"]["square_m"] = square_m; });
  };
  EXPECT_THAT(with_square(2.8), HasSubstr("boards.square_m: found squares of 2.8 m, so a board 56 m long"));
  EXPECT_THAT(with_square(2.8), HasSubstr("looks like centimetres: 0.028 m"));
  EXPECT_THAT(with_square(28), HasSubstr("looks like millimetres: 0.028 m"));
}

}  // namespace
}  // namespace dressform
