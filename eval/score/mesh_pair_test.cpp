#include "eval/score/mesh_pair.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/score/rigid_fit.h"
#include "eval/testing/test_meshes.h"
#include "scenes/error.h"
#include "scenes/mesh_io.h"

namespace dressform {
namespace {

using namespace test_meshes;
using testing::HasSubstr;
namespace fs = std::filesystem;

// A tube with nothing symmetric about it: wider to one side above, bent forwards.
Mesh crooked() {
  Mesh mesh = tube(0.2, 0.14, {0, 0, 0}, 0.9, 1.5, 48, 40, false);
  for (auto& v : mesh.vertices) {
    const double height = (v.y() - 0.9) / 0.6;
    v.x() *= v.x() > 0 ? 1 + 0.6 * height * height : 1 - 0.2 * height;
    v.z() += 0.12 * height * height + 0.05 * v.x();
  }
  return mesh;
}

class MeshPair : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("mesh_pair_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path written(const std::string& name, const Mesh& mesh) const {
    write_ply(folder_ / name, mesh);
    return folder_ / name;
  }
  static double value(const Scores& scores, const std::string& stage, const std::string& metric) {
    const auto* row = scores.find(stage, metric);
    return row && row->status == "ok" ? row->value : NAN;
  }
  fs::path folder_;
};

TEST_F(MeshPair, AMeshAgainstItselfIsPerfectAndAMovedOneIsNot) {
  const fs::path truth = written("truth.ply", crooked());
  const auto same = score_mesh_pair(truth, truth, MeshAlignment::none).scores;
  EXPECT_EQ(value(same, "surface", "mesh/f_2mm@1"), 1);
  EXPECT_EQ(value(same, "open", "mesh/loop_difference@1"), 0);
  EXPECT_NEAR(value(same, "open", "mesh/rims_hd95_mm@1"), 0, 1e-6);
  EXPECT_EQ(same.find("texture", "mesh/ssim@2")->status, "absent");
  const auto apart =
      score_mesh_pair(written("moved.ply", moved(crooked(), {0, 0.02, 0})), truth, MeshAlignment::none).scores;
  EXPECT_NEAR(value(apart, "open", "mesh/rims_hd95_mm@1"), 20, 0.5);
}

TEST_F(MeshPair, TheGaugeIsTakenOutWhenAskedFor) {
  const fs::path truth = written("truth.ply", crooked());
  for (const Eigen::AngleAxisd& turn :
       {Eigen::AngleAxisd(2.5, Vector3d::UnitY()), Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()),
        Eigen::AngleAxisd(0.3, Vector3d(1, 2, 3).normalized())}) {
    const Isometry3d motion = Eigen::Translation3d(0.4, -0.3, 0.2) * turn;
    const auto result =
        score_mesh_pair(written("turned.ply", transformed(crooked(), motion.matrix())), truth, MeshAlignment::gauge);
    EXPECT_NEAR((result.truth_from_estimate * motion).translation().norm(), 0, 1e-3);
    EXPECT_GT(value(result.scores, "surface", "mesh/f_2mm@1"), 0.99);
    EXPECT_THAT(result.scores.variant, HasSubstr("align=gauge"));
  }
}

TEST_F(MeshPair, TheEstimateMayBeInItsOwnUnitAndAxes) {
  const fs::path truth = written("truth.ply", crooked());
  Mesh centimetres = crooked();  // z up, front at -y
  for (auto& v : centimetres.vertices) v = 100 * Vector3d(v.x(), -v.z(), v.y());
  MeshFrame frame;
  frame.unit = "cm";
  frame.up = "z";
  const auto scores = score_mesh_pair(written("cm.ply", centimetres), truth, MeshAlignment::none, frame).scores;
  EXPECT_EQ(value(scores, "surface", "mesh/f_2mm@1"), 1);
}

TEST_F(MeshPair, NothingIsScaledOrMirrored) {
  const Mesh truth = crooked();
  Mesh larger = truth, mirrored = truth;
  for (auto& v : larger.vertices) v *= 1.1;
  for (auto& v : mirrored.vertices) v.x() = -v.x();
  for (const Mesh& estimate : {larger, mirrored}) {
    const Isometry3d motion = best_rigid_motion(estimate, truth);
    EXPECT_NEAR(motion.linear().determinant(), 1, 1e-9);
    EXPECT_NEAR((motion.linear() * motion.linear().transpose() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-9);
  }
}

TEST_F(MeshPair, WhatNobodySawOfTheTruthIsNotAskedFor) {
  PlyExtras extras;
  const Mesh whole = tube(0.2, 0.14, {0, 0, 0}, 0.9, 1.5, 48, 40, false);
  for (const auto& v : whole.vertices) extras.vertex_properties["views"].push_back(v.y() < 1.2 ? 0 : 2);
  write_ply(folder_ / "truth.ply", whole, extras);
  const fs::path half = written("half.ply", tube(0.2, 0.14, {0, 0, 0}, 1.2, 1.5, 48, 20, false));
  const auto scores = score_mesh_pair(half, folder_ / "truth.ply", MeshAlignment::none).scores;
  EXPECT_NEAR(value(scores, "surface", "mesh/unobserved_part@1"), 0.5, 0.03);
  EXPECT_GT(value(scores, "surface", "mesh/recall_5mm@1"), 0.98);
}

TEST_F(MeshPair, WhatCannotBeIsRefusedByFile) {
  const fs::path truth = written("truth.ply", crooked());
  Mesh millimetres = crooked();
  for (auto& v : millimetres.vertices) v *= 1000;
  const auto refusal = [&](const fs::path& estimate, const fs::path& other) -> std::string {
    try {
      score_mesh_pair(estimate, other, MeshAlignment::none);
    } catch (const InputError& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_THAT(refusal(written("mm.ply", millimetres), truth), HasSubstr("mm.ply: found a mesh of"));
  EXPECT_THAT(refusal(truth, written("mm.ply", millimetres)), HasSubstr("looks like millimetres"));
  EXPECT_THAT(refusal(folder_ / "none.ply", truth), HasSubstr("none.ply"));
}

}  // namespace
}  // namespace dressform
