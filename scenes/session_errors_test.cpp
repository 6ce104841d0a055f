#include <gmock/gmock.h>

#include <fstream>

#include "scenes/image_file.h"
#include "scenes/testing/session_folder.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

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
  EXPECT_THAT(error_with_image("naked/k1/depth.png", noise_image(kSampleGrid, CV_8UC1, 1)),
              HasSubstr("naked/k1/depth.png: found 8-bit grey; expected 16-bit grey"));
  EXPECT_THAT(error_with_image("naked/k1/ir.png", noise_image(kSampleColor, CV_16UC1, 1)),
              HasSubstr("ir.png: found 64 x 36"));
  EXPECT_THAT(error_with_image("dressed/k1/body_index.png", noise_image(kSampleGrid, CV_16UC1, 1)),
              HasSubstr("body_index.png"));
  EXPECT_THAT(error_with_image("naked/k1/color.png", noise_image(kSampleColor, CV_8UC4, 1)),
              HasSubstr("with transparency"));
  EXPECT_THAT(error_with_image("naked/k1/color.png", noise_image(kSampleColor, CV_16UC3, 1)),
              HasSubstr("found 16-bit colour"));
  EXPECT_THAT(error_with_image("naked/k1/color.png", noise_image(kSampleColor, CV_8UC1, 1)),
              HasSubstr("found 8-bit grey"));
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

}  // namespace
}  // namespace dressform
