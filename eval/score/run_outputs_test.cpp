#include "eval/score/run_outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "eval/testing/judged_figure.h"
#include "scenes/error.h"
#include "scenes/json_file.h"
#include "scenes/mesh_io.h"

namespace dressform {
namespace {

using namespace judged_figure;
namespace fs = std::filesystem;

// A run folder with what a flawless run hands out of the top.
class RunOutputsFolder : public testing::Test {
 protected:
  void SetUp() override {
    run = fs::path(testing::TempDir()) /
          (std::string("run_outputs_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(run);
    fs::create_directories(run / "out");
  }
  void TearDown() override { fs::remove_all(run); }
  void write_registration() const {
    nlohmann::ordered_json poses, converged;
    for (const auto& [sensor, pose] : written.model_from_sensor) poses[sensor] = to_json(pose);
    for (const auto& [sensor, flag] : written.converged) converged[sensor] = flag;
    write_json(run / "out/registration.json", {{"model_from_sensor", poses}, {"converged", converged}});
  }
  void write_top() const {
    write_ply(run / "out/naked_body.ply", written.naked_body);
    write_ply(run / "out/top.ply", written.garments.at("top").mesh);
    write_ply(run / "out/top_fitted.ply", written.garments.at("top").fitted);
    write_glb(run / "out/top.glb", written.garments.at("top").textured);
  }
  std::string refusal() const {
    try {
      read_foreign_outputs(run);
    } catch (const InputError& error) {
      return error.what();
    }
    return "taken";
  }
  const RunOutputs written = perfect_outputs(some_truth());
  fs::path run;
};

TEST_F(RunOutputsFolder, ReadFromARunFolder) {
  EXPECT_THROW(read_run_outputs(run), InputError);
  write_registration();
  EXPECT_TRUE(read_run_outputs(run).garments.empty());
  write_top();
  const RunOutputs read = read_run_outputs(run);
  EXPECT_EQ(read.naked_body.vertices, written.naked_body.vertices);
  EXPECT_EQ(read.garments.size(), 1u);
  EXPECT_EQ(read.garments.at("top").mesh.triangles, written.garments.at("top").mesh.triangles);
  EXPECT_EQ(read.garments.at("top").fitted.vertices, written.garments.at("top").fitted.vertices);
  EXPECT_EQ(read.garments.at("top").textured.texture.size(), cv::Size(64, 64));
  EXPECT_FALSE(read.user_model_from_frame0);
  EXPECT_TRUE(read.converged.at("k1"));
  EXPECT_EQ(refusal(), "taken");
  std::ofstream(run / "out/top.ply") << "ply\n";
  EXPECT_THROW(read_run_outputs(run), InputError);
}

TEST_F(RunOutputsFolder, SomeoneElsesMillimetresAreRefusedBeforeTheyAreScored) {
  write_registration();
  write_top();
  Mesh millimetres = written.garments.at("top").mesh;
  for (auto& vertex : millimetres.vertices) vertex *= 1000;
  write_ply(run / "out/top.ply", millimetres);
  EXPECT_THAT(refusal(), testing::HasSubstr("out/top.ply: found a mesh of"));
  EXPECT_THAT(refusal(), testing::HasSubstr("looks like millimetres"));
}

TEST_F(RunOutputsFolder, APlyAndAGlbThatContradictEachOtherAreRefused) {
  write_registration();
  write_top();
  TexturedMesh other = written.garments.at("top").textured;
  other.mesh = moved(other.mesh, {0, 0.03, 0});
  write_glb(run / "out/top.glb", other);
  EXPECT_THAT(refusal(), testing::HasSubstr("out/top.ply: contradicts top.glb"));
  fs::remove(run / "out/top.glb");
  EXPECT_EQ(refusal(), "taken");
}

}  // namespace
}  // namespace dressform
