// Rigs of other sizes than four: the fewest and the most that a scene may have, at places of their own.
#include <gtest/gtest.h>

#include <fstream>

#include "eval/run/scene_run.h"
#include "scenes/mesh_io.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

constexpr double kScale = 0.25;

// Group 1 before a ring of sensors that stand at equal steps, now lower, now higher, tilted a little.
fs::path write_ring_scene(const fs::path& folder, int sensors) {
  const std::string library = (fs::path(DRESSFORM_SOURCE_DIR) / "scenes/library").string();
  const fs::path file = folder / "ring.toml";
  fs::create_directories(folder);
  std::ofstream out(file);
  out << "name = \"ring\"\nroom = \"" << library << "/rooms/laboratory.toml\"\nbody = \"" << library
      << "/bodies/mannequin.toml\"\nuser = \"" << library << "/bodies/customer.toml\"\nscan = \"" << library
      << "/scans/handheld.toml\"\ngarment = [\"" << library << "/garments/shirt1.toml\", \"" << library
      << "/garments/trousers1.toml\"]\n[sensor]\nmodel = \"fankhauser\"\n[rig]\n";
  for (int i = 0; i < sensors; ++i)
    out << "[[rig.sensor]]\nname = \"s" << i << "\"\nbody_tracking = " << (i == 0 ? "true" : "false")
        << "\nazimuth_deg = " << 7 + 360.0 * i / sensors << "\ndistance_m = " << (i % 2 ? 2.0 : 2.2)
        << "\nheight_m = " << (i % 3 ? 1.2 : 1.35) << "\npitch_deg = " << (i % 3 ? 0 : -4)
        << "\nroll_deg = " << (i % 2 ? 1.5 : -1)
        << "\ncolor = {width = 1920, height = 1080, fx = 1066.0, fy = 1068.9, cx = 945.6, cy = 520.1}"
           "\nir = {width = 512, height = 424, fx = 366.4, fy = 367.1, cx = 255.7, cy = 204.0}"
           "\ncolor_from_ir = {translation_m = [0.0512, 0.0, -0.002]}\n";
  return file;
}

ScoreRow row_of(const Scores& scores, const std::string& stage, const std::string& metric) {
  for (const auto& row : scores.rows)
    if (row.stage == stage && row.metric == metric) return row;
  ADD_FAILURE() << "no row " << stage << ' ' << metric;
  return {};
}

class EndToEndRigs : public testing::TestWithParam<int> {
 protected:
  static fs::path folder() { return fs::path(testing::TempDir()) / "road_rigs"; }
  static void SetUpTestSuite() { fs::remove_all(folder()); }
  EndToEndResult run(int sensors) const {
    SceneRunRequest request;
    request.scene = scaled(read_scene(write_ring_scene(folder() / "scene", sensors)), kScale);
    request.scale = kScale;
    request.output = folder() / std::to_string(sensors);
    request.store = folder() / "store";  // the scans are the same: fused once
    return run_scene(request);
  }
};

TEST_P(EndToEndRigs, RunThroughToFittedClothes) {
  const int sensors = GetParam();
  const auto result = run(sensors);
  ASSERT_TRUE(result.scores);
  const auto rotation = row_of(*result.scores, "registration", "max/rotation_deg@1");
  EXPECT_EQ(rotation.n_samples, sensors - 1) << "all but the one that joins model and world";
  EXPECT_LT(rotation.value, 0.5);
  EXPECT_LT(row_of(*result.scores, "registration", "max/tre_mm@1").value, 4);
  if (sensors < 4) return;  // what one side shows is not always enough for a garment that closes round the body
  for (const std::string slot : {"top", "bottom"}) {
    const auto fitted = read_textured_mesh(folder() / std::to_string(sensors) / "out" / (slot + "_fitted.glb"));
    EXPECT_EQ(topology(fitted.mesh).components, 1) << slot;
    EXPECT_EQ(topology(fitted.mesh).loops, slot == "top" ? 4 : 3) << slot;
    EXPECT_GT(row_of(*result.scores, "surface", slot + "/f_10mm@1").value, 0.9) << slot;
  }
}

INSTANTIATE_TEST_SUITE_P(FewestAndMost, EndToEndRigs, testing::Values(1, 12));

}  // namespace
}  // namespace dressform
