#include "scenes/capture_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "scenes/error.h"
#include "scenes/image_file.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

const cv::Size kGrid(32, 26), kColor(64, 36);

cv::Mat noise(cv::Size size, int type, int stream) {
  cv::Mat image(size, type);
  cv::RNG generator(static_cast<std::uint64_t>(stream) + 1);
  generator.fill(image, cv::RNG::UNIFORM, 0, CV_MAT_DEPTH(type) == CV_16U ? 65536 : 256);
  return image;
}

// Depth of a room, with holes.
cv::Mat some_depth(int stream) {
  cv::Mat depth(kGrid, CV_16UC1);
  cv::RNG(static_cast<std::uint64_t>(stream) + 1).fill(depth, cv::RNG::UNIFORM, 500, 4500);
  depth.row(0).setTo(0);
  return depth;
}

Shot some_shot(int stream) {
  Shot shot;
  shot.color = noise(kColor, CV_8UC3, stream);
  shot.depth_mm = some_depth(stream + 100);
  shot.ir = noise(kGrid, CV_16UC1, stream + 200);
  return shot;
}

SensorCalibration some_calibration() {
  SensorCalibration sensor;
  sensor.model = "kinect_v2";
  sensor.color = Camera{kColor.width, kColor.height, 30.1, 30.2, 31.5, 17.9, {0.1, -0.2, 1e-3, 2e-3, 0.03}};
  sensor.ir = Camera{kGrid.width, kGrid.height, 20.1, 1.0 / 3 + 20, 16, 13, {0.05, 0, 0, 0, 0}};
  sensor.color_from_ir = Eigen::Translation3d(0.05, 0, 0.001) * Eigen::AngleAxisd(0.01, Vector3d(1, 2, 3).normalized());
  sensor.depth_offset_m = -0.0133;
  return sensor;
}

CaptureSession some_session() {
  CaptureSession session;
  session.name = "sample";
  session.created_by = "test";
  session.licence = "CC0-1.0";
  session.sensors = {"k1", "k2"};
  session.calibration.emplace();
  int stream = 0;
  for (const auto& name : session.sensors) {
    session.calibration->sensors[name] = some_calibration();
    session.naked[name] = some_shot(++stream);
    session.dressed[name] = some_shot(++stream);
  }
  session.dressed["k1"].body_index = noise(kGrid, CV_8UC1, 7);
  session.dressed["k1"].skeleton = Skeleton{{"Head", {Vector3d(0.1, 1.0 / 3, 2), true}}, {"Neck", {}}};
  auto handheld = some_calibration();
  handheld.color.reset();
  handheld.color_from_ir = Isometry3d::Identity();
  session.calibration->sensors["handheld"] = handheld;
  for (const char* name : {"scan_naked", "scan_user"})
    session.scans[name] = {"handheld", {some_depth(300), some_depth(301)}};
  session.prior.emplace();
  for (const auto& name : session.sensors)
    session.prior->world_from_sensor[name] = some_calibration().color_from_ir * Eigen::Translation3d(1, 2, 3);
  return session;
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  if (a.empty() || b.empty()) return a.empty() && b.empty();
  return a.type() == b.type() && a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

void expect_same(const Shot& a, const Shot& b) {
  EXPECT_TRUE(same(a.color, b.color));
  EXPECT_TRUE(same(a.depth_mm, b.depth_mm));
  EXPECT_TRUE(same(a.ir, b.ir));
  EXPECT_TRUE(same(a.body_index, b.body_index));
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
    root_ = fs::path(testing::TempDir()) / ("session_" + std::string(test_name()));
    fs::remove_all(root_);
    fs::create_directories(root_);
    folder_ = root_ / "sample";
    write_capture_session(folder_, some_session());
  }
  void TearDown() override { fs::remove_all(root_); }
  static const char* test_name() { return testing::UnitTest::GetInstance()->current_test_info()->name(); }

  std::string error() const {
    try {
      read_capture_session(folder_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  json load(const std::string& name) const { return json::parse(std::ifstream(folder_ / name)); }
  void store(const std::string& name, const json& value) const { std::ofstream(folder_ / name) << value; }
  // The error after one change of a JSON file, which is then undone.
  template <class Change>
  std::string error_after(const std::string& name, Change change) const {
    const json before = load(name);
    json after = before;
    change(after);
    store(name, after);
    const std::string text = error();
    store(name, before);
    return text;
  }
  std::string error_with_image(const std::string& name, const cv::Mat& image) const {
    const fs::path kept = root_ / "kept.png";
    fs::copy_file(folder_ / name, kept, fs::copy_options::overwrite_existing);
    cv::imwrite((folder_ / name).string(), image);
    const std::string text = error();
    fs::copy_file(kept, folder_ / name, fs::copy_options::overwrite_existing);
    return text;
  }
  fs::path root_, folder_;
};

TEST_F(SessionFolder, RoundTrip) {
  const CaptureSession written = some_session(), read = read_capture_session(folder_);
  EXPECT_EQ(read.name, written.name);
  EXPECT_EQ(read.created_by, written.created_by);
  EXPECT_EQ(read.licence, written.licence);
  EXPECT_EQ(read.sensors, written.sensors);
  for (const auto& name : read.sensors) {
    expect_same(read.naked.at(name), written.naked.at(name));
    expect_same(read.dressed.at(name), written.dressed.at(name));
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
  EXPECT_TRUE(same(read.scans.at("scan_user").depth_mm[1], written.scans.at("scan_user").depth_mm[1]));
  EXPECT_EQ(read.prior->rotation_sigma_deg, 5);
  EXPECT_FALSE(read.boards);
}

TEST_F(SessionFolder, JpegColour) {
  fs::remove(folder_ / "naked/k1/color.png");
  cv::imwrite((folder_ / "naked/k1/color.jpg").string(), cv::Mat(kColor, CV_8UC3, cv::Scalar(200, 100, 50)));
  EXPECT_EQ(error(), "no error");
  const auto color = read_capture_session(folder_).naked["k1"].color;
  EXPECT_NEAR(color.at<cv::Vec3b>(9, 9)[0], 200, 4);
  fs::resize_file(folder_ / "naked/k1/color.jpg", fs::file_size(folder_ / "naked/k1/color.jpg") - 20);
  EXPECT_THAT(error(), HasSubstr("naked/k1/color.jpg: is damaged"));
  cv::imwrite((folder_ / "naked/k1/color.png").string(), color);
  EXPECT_THAT(error(), HasSubstr("color.png and color.jpg"));
}

TEST_F(SessionFolder, WriterRefusesAnExistingFolder) {
  EXPECT_THROW(write_capture_session(folder_, some_session()), InputError);
  EXPECT_EQ(std::distance(fs::directory_iterator(root_), {}), 1) << "nothing is left behind";
}

TEST_F(SessionFolder, UnknownKeysAreLeftAlone) {
  EXPECT_EQ(error_after("session.json", [](json& file) { file["weather"] = "fine"; }), "no error");
}

TEST_F(SessionFolder, HeaderErrors) {
  const auto after = [&](auto change) { return error_after("session.json", change); };
  EXPECT_THAT(after([](json& f) { f["version"] = 2; }), HasSubstr("session.json: version: found 2; expected 1"));
  EXPECT_THAT(after([](json& f) { f["format"] = "x"; }), HasSubstr("session.json: format: found \"x\""));
  EXPECT_THAT(after([](json& f) { f.erase("name"); }), HasSubstr("session.json: name: is missing"));
  EXPECT_THAT(after([](json& f) { f["sensors"] = json::array(); }), HasSubstr("session.json: sensors: found none"));
  EXPECT_THAT(after([](json& f) { f["sensors"] = {"k1", "k1"}; }), HasSubstr("twice"));
  EXPECT_THAT(after([](json& f) { f["sensors"][0] = "../k1"; }),
              HasSubstr("session.json: sensors[0]: found \"../k1\""));
  EXPECT_THAT(after([](json& f) { f["sensors"][0] = ".."; }), HasSubstr("session.json: sensors[0]"));
  EXPECT_THAT(after([](json& f) { f["sensors"][0] = "/etc"; }), HasSubstr("session.json: sensors[0]"));
  EXPECT_THAT(after([](json& f) { f["shots"]["naked"][0] = "k9"; }),
              HasSubstr("session.json: shots.naked: found \"k9\""));
  EXPECT_THAT(after([](json& f) { f["shots"].erase("dressed"); }),
              HasSubstr("session.json: shots.dressed: is missing"));
  EXPECT_THAT(after([](json& f) { f["scans"]["scan_user"]["frames"] = 3; }), HasSubstr("0002_depth.png: is missing"));
  EXPECT_THAT(after([](json& f) { f["scans"]["scan_user"]["frames"] = 1; }),
              HasSubstr("scans.scan_user.frames: found 2"));
  EXPECT_THAT(after([](json& f) { f["scans"]["scan_user"]["frames"] = 1.5; }), HasSubstr("whole number"));
  EXPECT_THAT(after([](json& f) { f["scans"]["scan_user"]["sensor"] = "x"; }), HasSubstr("scans.scan_user.sensor"));
  EXPECT_THAT(after([](json& f) { f["prior_sigma"].erase("rotation_deg"); }), HasSubstr("prior_sigma.rotation_deg"));
}

TEST_F(SessionFolder, MatrixErrors) {
  const auto after = [&](auto change) {
    return error_after("session.json", [&](json& f) { change(f["world_from_sensor_prior"]["k2"]); });
  };
  const std::string field = "session.json: world_from_sensor_prior.k2: found a matrix that is no rotation";
  EXPECT_THAT(after([](json& m) { m[0][0] = 0.7; }), HasSubstr(field));
  EXPECT_THAT(after([](json& m) {
                for (auto& row : m) row[0] = -row[0].get<double>();
              }),
              HasSubstr(field));
  EXPECT_THAT(after([](json& m) { m[3][0] = 0.5; }), HasSubstr(field));
  EXPECT_THAT(after([](json& m) {
                json transposed = m;
                for (int i = 0; i < 4; ++i)
                  for (int k = 0; k < 4; ++k) transposed[i][k] = m[k][i];
                m = transposed;
              }),
              HasSubstr("looks transposed: the translation stands in the last row"));
  EXPECT_THAT(after([](json& m) {
                for (int i = 0; i < 3; ++i)
                  for (int k = 0; k < 3; ++k) m[i][k] = 2 * m[i][k].get<double>();
              }),
              HasSubstr("its axes are 2 long instead of 1"));
  EXPECT_THAT(after([](json& m) { m[0][3] = nullptr; }), HasSubstr("world_from_sensor_prior.k2[0][3]: found null"));
  EXPECT_THAT(after([](json& m) { m.erase(3); }), HasSubstr("found 3 rows"));
  EXPECT_EQ(after([](json& m) { m[0][0] = std::round(m[0][0].get<double>() * 1e5) / 1e5; }), "no error");
}

TEST_F(SessionFolder, NumbersThatAreNotFinite) {
  std::string text;
  std::getline(std::ifstream(folder_ / "calibration.json"), text, '\0');
  for (const char* bad : {"NaN", "1e999", "Infinity"}) {
    std::string broken = text;
    broken.replace(broken.find("30.1"), 4, bad);
    std::ofstream(folder_ / "calibration.json") << broken;
    EXPECT_THAT(error(), HasSubstr("calibration.json: is not JSON with finite numbers")) << bad;
  }
}

TEST_F(SessionFolder, CalibrationErrors) {
  const auto after = [&](auto change) {
    return error_after("calibration.json", [&](json& f) { change(f["sensors"]); });
  };
  EXPECT_THAT(after([](json& s) { s.erase("k2"); }), HasSubstr("calibration.json: sensors.k2: is missing"));
  EXPECT_THAT(after([](json& s) { s["k2"]["ir"].erase("fx"); }), HasSubstr("sensors.k2.ir.fx: is missing"));
  EXPECT_THAT(after([](json& s) { s["k2"]["ir"]["fx"] = 0; }), HasSubstr("sensors.k2.ir.fx: found 0"));
  EXPECT_THAT(after([](json& s) {
                s["k2"]["ir"]["distortion"] = {0, 0, 0, 0};
              }),
              HasSubstr("found 4 numbers; expected 5"));
  EXPECT_THAT(after([](json& s) { s["k2"].erase("color_from_ir"); }), HasSubstr("color_from_ir: is missing"));
  EXPECT_THAT(after([](json& s) { s["k1"]["ir"]["width"] = 33; }),
              HasSubstr("depth.png: found 32 x 26 pixels; expected 33 x 26"));
  EXPECT_THAT(after([](json& s) { s["k2"]["color"]["fy"] = -1068.7; }),
              HasSubstr("sensors.k2.color.fy: found -1068.7 px; expected a positive focal length"));
  EXPECT_THAT(after([](json& s) { s["k1"]["ir"]["fx"] = 0.72; }), HasSubstr("looks like a part of the width"));
  EXPECT_THAT(after([](json& s) { s["k1"]["color"]["cx"] = 960; }),
              HasSubstr("sensors.k1.color.cx: found a principal point at 960 px, outside the image of 64 px"));
  EXPECT_THAT(after([](json& s) { s["k1"]["color_from_ir"][0][3] = 51.2; }),
              HasSubstr("sensors.k1.color_from_ir: found a step of 51.2 m"));
  EXPECT_THAT(after([](json& s) { s["k1"]["color_from_ir"][0][3] = 51.2; }), HasSubstr("looks like millimetres"));
  EXPECT_THAT(after([](json& s) { s["k1"]["depth_offset_m"] = -13.35; }),
              HasSubstr("sensors.k1.depth_offset_m: found -13.35 m"));
  fs::remove(folder_ / "calibration.json");
  EXPECT_THAT(error(), HasSubstr("calibration.json: is missing"));
}

TEST_F(SessionFolder, ImageErrors) {
  EXPECT_THAT(error_with_image("naked/k1/depth.png", noise(kGrid, CV_8UC1, 1)),
              HasSubstr("naked/k1/depth.png: found 8-bit grey; expected 16-bit grey"));
  EXPECT_THAT(error_with_image("naked/k1/ir.png", noise(kColor, CV_16UC1, 1)), HasSubstr("ir.png: found 64 x 36"));
  EXPECT_THAT(error_with_image("dressed/k1/body_index.png", noise(kGrid, CV_16UC1, 1)), HasSubstr("body_index.png"));
  EXPECT_THAT(error_with_image("naked/k1/color.png", noise(kColor, CV_8UC4, 1)), HasSubstr("with transparency"));
  EXPECT_THAT(error_with_image("naked/k1/color.png", noise(kColor, CV_16UC3, 1)), HasSubstr("found 16-bit colour"));
  EXPECT_THAT(error_with_image("naked/k1/color.png", noise(kColor, CV_8UC1, 1)), HasSubstr("found 8-bit grey"));
  EXPECT_EQ(error(), "no error");
}

TEST_F(SessionFolder, DamagedFiles) {
  for (const char* name : {"scan_naked/0001_depth.png", "naked/k2/color.png", "dressed/k1/ir.png"}) {
    SCOPED_TRACE(name);
    const fs::path file = folder_ / name, kept = root_ / "kept";
    fs::copy_file(file, kept, fs::copy_options::overwrite_existing);
    fs::resize_file(file, fs::file_size(file) / 2);
    EXPECT_THAT(error(), HasSubstr(std::string(name) + ": is damaged"));
    fs::resize_file(file, 0);
    EXPECT_THAT(error(), HasSubstr(std::string(name) + ": found no PNG"));
    fs::remove(file);
    const bool optional = std::string(name).find("ir.png") != std::string::npos;
    EXPECT_THAT(error(), HasSubstr(optional ? "no error" : std::string(name) + ": is missing"));
    fs::copy_file(kept, file);
    std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(80).put('\x55').put('\x2a');
    EXPECT_THAT(error(), HasSubstr(std::string(name) + ": is damaged"));
    fs::copy_file(kept, file, fs::copy_options::overwrite_existing);
  }
  std::ofstream(folder_ / "session.json") << "{";
  EXPECT_THAT(error(), HasSubstr("session.json: is not JSON"));
  fs::remove(folder_ / "session.json");
  EXPECT_THAT(error(), HasSubstr("session.json: is missing"));
  fs::remove_all(folder_);
  EXPECT_THAT(error(), HasSubstr("is missing"));
}

TEST_F(SessionFolder, LinksThatLeadOut) {
  fs::rename(folder_ / "naked/k1/ir.png", root_ / "ir.png");
  fs::create_symlink(root_ / "ir.png", folder_ / "naked/k1/ir.png");
  EXPECT_THAT(error(), HasSubstr("naked/k1/ir.png: leads out of the session"));
}

TEST_F(SessionFolder, SkeletonErrors) {
  const auto after = [&](auto change) { return error_after("dressed/k1/skeleton.json", change); };
  EXPECT_THAT(after([](json& f) { f["joints"]["Tail"] = json::object(); }), HasSubstr("skeleton.json: joints.Tail"));
  EXPECT_THAT(after([](json& f) { f["joints"]["Head"].erase("tracked"); }), HasSubstr("joints.Head.tracked"));
}

TEST_F(SessionFolder, BoardsInsteadOfACalibration) {
  CaptureSession session = some_session();
  session.calibration.reset();
  session.boards.emplace();
  session.boards->inner_corners_x = 11;
  session.boards->inner_corners_y = 19;
  session.boards->square_m = 0.028;
  for (const auto& name : session.sensors) {
    const Shot shot = some_shot(50);
    session.boards->shots[name] = {{shot.color, shot.ir, shot.depth_mm}, {shot.color, shot.ir, shot.depth_mm}};
  }
  folder_ = root_ / "boards";
  write_capture_session(folder_, session);
  const CaptureSession read = read_capture_session(folder_);
  EXPECT_FALSE(read.calibration);
  ASSERT_TRUE(read.boards);
  EXPECT_EQ(read.boards->inner_corners_y, 19);
  EXPECT_TRUE(same(read.boards->shots.at("k2")[1].ir, session.boards->shots.at("k2")[1].ir));
  EXPECT_THAT(error_with_image("boards/k2/01_ir.png", noise(kColor, CV_16UC1, 1)), HasSubstr("differs in size"));
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

TEST_F(SessionFolder, DepthThatIsNone) {
  cv::Mat depth = some_depth(1);
  depth.at<std::uint16_t>(9, 9) = 65535;
  EXPECT_THAT(
      error_with_image("naked/k1/depth.png", depth),
      HasSubstr("naked/k1/depth.png: found 65535 (0xFFFF) in 1 of 832 pixels, 65.5 m if it were depth, which is "
                "what recorders write where there is no depth; expected millimetres, and 0 for none"));
  EXPECT_THAT(error_with_image("scan_user/0001_depth.png", depth), HasSubstr("scan_user/0001_depth.png: found 65535"));
  EXPECT_THAT(error_with_image("dressed/k2/depth.png", cv::Mat::zeros(kGrid, CV_16UC1)),
              HasSubstr("dressed/k2/depth.png: found no pixel with depth"));
  EXPECT_EQ(error_with_image("scan_user/0001_depth.png", cv::Mat::zeros(kGrid, CV_16UC1)), "no error")
      << "a frame may be lost, a scan may not";
  cv::imwrite((folder_ / "scan_user/0000_depth.png").string(), cv::Mat::zeros(kGrid, CV_16UC1));
  EXPECT_THAT(error_with_image("scan_user/0001_depth.png", cv::Mat::zeros(kGrid, CV_16UC1)),
              HasSubstr("scan_user: found no pixel with depth"));
}

TEST_F(SessionFolder, DepthInAnotherUnit) {
  EXPECT_THAT(error_with_image("naked/k1/depth.png", some_depth(1) / 10),
              HasSubstr("naked/k1/depth.png: found depth of 0.2"));
  EXPECT_THAT(error_with_image("naked/k1/depth.png", some_depth(1) / 10),
              HasSubstr("(looks like centimetres, 100 a metre)"));
  EXPECT_THAT(error_with_image("dressed/k1/depth.png", some_depth(1) * 5), HasSubstr("(looks like 5000 a metre)"));
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
  CaptureSession session = some_session();
  session.boards.emplace();
  session.boards->inner_corners_x = 11, session.boards->inner_corners_y = 19, session.boards->square_m = 0.028;
  const Shot shot = some_shot(50);
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

TEST_F(SessionFolder, ContentHash) {
  const std::string before = session_content_hash(folder_);
  EXPECT_EQ(session_content_hash(folder_), before);
  fs::create_directories(folder_ / "truth");
  std::ofstream(folder_ / "truth/scene.toml") << "x";
  EXPECT_EQ(session_content_hash(folder_), before) << "the truth does not count";
  write_capture_session(root_ / "other", some_session());
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
