#include "scenes/ground_truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "scenes/error.h"
#include "scenes/mesh_io.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

Mesh tetrahedron(double size) {
  return {{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

TruthGarment some_garment() {
  TruthGarment garment;
  garment.mesh = tetrahedron(0.3);
  garment.mesh.triangles.pop_back();  // open
  garment.views = {0, 1, 2, 4};
  garment.textured.mesh = garment.mesh;
  garment.textured.corner_uv.assign(3, {Vector2f(0, 0), Vector2f(0.5f, 0), Vector2f(0, 0.25f)});
  garment.textured.texture = cv::Mat(8, 16, CV_8UC3, cv::Scalar(10, 120, 200));
  garment.rest = {false, 0.03125, 0.0625};
  return garment;
}

GroundTruth some_truth() {
  GroundTruth truth;
  Isometry3d pose = Eigen::Translation3d(0.1, 1.25, 2.1) * Eigen::AngleAxisd(1.0, Vector3d(1, 2, 3).normalized());
  truth.world_from_sensor = {{"k1", pose}, {"k2", pose.inverse()}};
  truth.scan_world_from_sensor["scan_naked"] = {pose, Isometry3d::Identity()};
  truth.scan_world_from_sensor["scan_user"] = {pose.inverse()};
  truth.naked_body = tetrahedron(1.0 / 3);
  truth.user_body = tetrahedron(0.9);
  truth.garments["top"] = some_garment();
  truth.rims["top"] = {{"neck", 0.75, {{0.3, 0, 0}, {0, 0.3, 0}, {0, 0, 0.3}}}};
  for (const char* name : {"k1", "k2"}) truth.labels[name] = cv::Mat(9, 16, CV_8UC1, cv::Scalar(2));
  truth.scene_toml = "name = \"a\"\n";
  return truth;
}

class TruthFolder : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("truth_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write_ground_truth(folder_, some_truth());
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string error() const {
    try {
      read_ground_truth(folder_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  template <class Change>
  std::string error_after(const std::string& name, Change change) const {
    const fs::path file = folder_ / "truth" / name;
    const json before = json::parse(std::ifstream(file));
    json after = before;
    change(after);
    std::ofstream(file) << after;
    const std::string text = error();
    std::ofstream(file) << before;
    return text;
  }
  fs::path folder_;
};

TEST_F(TruthFolder, RoundTrip) {
  EXPECT_TRUE(ground_truth_exists(folder_));
  EXPECT_FALSE(ground_truth_exists(folder_ / "truth"));
  const GroundTruth written = some_truth(), read = read_ground_truth(folder_);
  for (const auto& [name, pose] : written.world_from_sensor)
    EXPECT_TRUE(read.world_from_sensor.at(name).isApprox(pose, 1e-14));
  EXPECT_EQ(read.scan_world_from_sensor.at("scan_naked").size(), 2u);
  EXPECT_EQ(read.scan_world_from_sensor.at("scan_user").size(), 1u);
  EXPECT_FALSE(read.calibration);
  EXPECT_EQ(read.naked_body.vertices, written.naked_body.vertices);
  EXPECT_EQ(read.user_body.triangles, written.user_body.triangles);
  ASSERT_EQ(read.garments.size(), 1u);
  const auto &a = read.garments.at("top"), &b = written.garments.at("top");
  EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.views, b.views);
  EXPECT_EQ(a.textured.mesh.triangles.size(), 3u);
  EXPECT_EQ(a.textured.texture.size(), cv::Size(16, 8));
  EXPECT_NEAR(a.textured.corner_uv[1][2].y(), 0.25, 1e-6);
  EXPECT_FALSE(a.rest.settled);
  EXPECT_EQ(a.rest.speed_m_per_s, b.rest.speed_m_per_s);
  EXPECT_EQ(a.rest.strain_p95, b.rest.strain_p95);
  ASSERT_EQ(read.rims.at("top").size(), 1u);
  EXPECT_EQ(read.rims.at("top")[0].name, "neck");
  EXPECT_EQ(read.rims.at("top")[0].visible, 0.75);
  EXPECT_EQ(read.rims.at("top")[0].points[1], Vector3d(0, 0.3, 0));
  EXPECT_EQ(read.labels.at("k2").at<std::uint8_t>(3, 3), 2);
  EXPECT_EQ(read.scene_toml, written.scene_toml);
}

// What does not lie as cloth does is said, one line each.
TEST_F(TruthFolder, WarnsOfClothThatDidNotSettle) {
  const auto lines = drape_warnings(folder_);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_THAT(lines[0], HasSubstr("top: the cloth did not come to rest, it still moves at 31 mm/s"));
  EXPECT_THAT(lines[1], HasSubstr("top: the cloth is stretched by up to 6.2 %"));
  GroundTruth good = some_truth();
  good.garments["top"].rest = {true, 0.001, 0.03};
  fs::remove_all(folder_ / "truth");
  EXPECT_TRUE(drape_warnings(folder_).empty());
  write_ground_truth(folder_, good);
  EXPECT_TRUE(drape_warnings(folder_).empty());
  fs::remove(folder_ / "truth/garments/rest.json");  // as sessions of before are
  EXPECT_TRUE(read_ground_truth(folder_).garments.at("top").rest.settled);
}

TEST_F(TruthFolder, WriterRefusesExistingTruth) {
  EXPECT_THROW(write_ground_truth(folder_, some_truth()), InputError);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(TruthFolder, Damage) {
  EXPECT_THAT(error_after("world_from_sensor.json", [](json& f) { f["sensors"]["k1"][0][0] = 3; }),
              HasSubstr("world_from_sensor.json: sensors.k1: found a matrix that is no rotation"));
  EXPECT_THAT(error_after("rims.json", [](json& f) { f.erase("top"); }), HasSubstr("rims.json: top: is missing"));
  EXPECT_THAT(error_after("rims.json", [](json& f) { f["top"][0]["visible"] = 2; }),
              HasSubstr("rims.json: top[0].visible: found 2"));
  EXPECT_THAT(error_after("rims.json", [](json& f) { f["top"][0]["points"][1].erase(2); }),
              HasSubstr("found 2 numbers"));
  cv::imwrite((folder_ / "truth/labels/k1.png").string(), cv::Mat(9, 16, CV_8UC1, cv::Scalar(9)));
  EXPECT_THAT(error(), HasSubstr("labels/k1.png: found label 9"));
  fs::remove(folder_ / "truth/labels/k1.png");
  EXPECT_EQ(error(), "no error") << "labels of a sensor may be absent";
  fs::resize_file(folder_ / "truth/user_body.ply", 100);
  EXPECT_THAT(error(), HasSubstr("user_body.ply"));
  fs::remove_all(folder_ / "truth");
  EXPECT_THAT(error(), HasSubstr("truth: is missing"));
}

// Others' truth is often there in part only: what is missing is empty.
TEST_F(TruthFolder, AnyPartMayBeMissing) {
  const fs::path truth = folder_ / "truth";
  EXPECT_EQ(truth_garment_names(folder_), std::vector<std::string>{"top"});
  fs::remove(truth / "garments/top.glb");
  EXPECT_TRUE(read_ground_truth(folder_).garments.at("top").textured.mesh.triangles.empty());
  write_ply(truth / "garments/top.ply", some_garment().mesh);  // without `views`
  EXPECT_TRUE(read_ground_truth(folder_).garments.at("top").views.empty());
  for (const char* name : {"rims.json", "labels", "scene.toml", "user_body.ply", "naked_body.ply", "garments"})
    fs::remove_all(truth / name);
  const GroundTruth poses = read_ground_truth(folder_);
  EXPECT_EQ(poses.world_from_sensor.size(), 2u);
  EXPECT_TRUE(poses.garments.empty() && poses.rims.empty() && poses.labels.empty());
  EXPECT_TRUE(truth_garment_names(folder_).empty());
  fs::remove(truth / "world_from_sensor.json");
  EXPECT_THAT(error(), HasSubstr("neither poses nor garments"));
}

}  // namespace
}  // namespace dressform
