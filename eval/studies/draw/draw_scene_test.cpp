#include "eval/studies/draw/draw_scene.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>

#include "scenes/error.h"
#include "synthetic/body/anthropometry.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// The scene as `run` would read it from the drawn file.
Scene read_back(const DrawnScene& drawn) {
  const fs::path file = fs::path(testing::TempDir()) / "drawn_scene.toml";
  std::ofstream(file) << scene_toml(drawn);
  return read_scene(file);
}

void expect_inside(const Scene& scene, const Vector3d& place) {
  EXPECT_LT(std::abs(place.x()), 0.5 * scene.room.width_m);
  EXPECT_LT(std::abs(place.z()), 0.5 * scene.room.depth_m);
  EXPECT_GT(place.y(), 0);
  EXPECT_LT(place.y(), scene.room.height_m);
}

// Soles and crown lie in the infrared image of every sensor.
void expect_whole_person_in_view(const Scene& scene) {
  for (const auto& sensor : scene.rig)
    for (const double y : {0.0, scene.body.stature_m}) {
      const Vector3d seen = sensor.world_from_sensor.inverse() * Vector3d(0, y, 0);
      const Camera& ir = sensor.calibration.ir;
      const double row = ir.fy * seen.y() / seen.z() + ir.cy;
      EXPECT_GT(row, 0) << sensor.name;
      EXPECT_LT(row, ir.height) << sensor.name;
    }
}

void expect_valid(const DrawnScene& drawn) {
  const Scene scene = read_back(drawn);
  EXPECT_EQ(scene.name, drawn.name);
  ASSERT_EQ(scene.rig.size(), drawn.rig.size());
  ASSERT_EQ(scene.garments.size(), drawn.garments.size());
  EXPECT_NO_THROW(check_measures(scene.body));
  EXPECT_NO_THROW(check_measures(scene.user));
  for (const auto& sensor : scene.rig) expect_inside(scene, sensor.world_from_sensor.translation());
  for (const auto& light : scene.lights) expect_inside(scene, light.position_m);
  expect_whole_person_in_view(scene);
  const double walk_m = scene.scan.radius_m + 0.1;
  EXPECT_LT(walk_m, 0.5 * std::min(scene.room.width_m, scene.room.depth_m));
}

TEST(DrawScene, TwoHundredAreValidAndDiffer) {
  std::map<std::string, int> kinds, prints, poses, strata;
  std::set<std::string> texts, counts;
  for (Seed seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    const DrawnScene drawn = draw_scene({}, seed);
    expect_valid(drawn);
    texts.insert(scene_toml(drawn));
    counts.insert(std::to_string(drawn.rig.size()));
    ++poses[drawn.body.pose];
    for (const auto& garment : drawn.garments) ++kinds[garment.name], ++prints[garment.print.kind];
    for (const auto& stratum : strata_of(drawn)) ++strata[stratum];
  }
  EXPECT_EQ(texts.size(), 200u);
  EXPECT_EQ(counts, (std::set<std::string>{"3", "4", "5", "6", "8"}));
  EXPECT_EQ(kinds.size(), 7u);  // shirt, polo shirt, hooded top, dress, trousers, shorts, skirt
  EXPECT_EQ(prints.size(), 10u);
  EXPECT_EQ(poses.size(), 3u);
  for (const char* stratum : {"skirt", "dress", "tucked", "long_sleeves", "three_sensors", "stout"})
    EXPECT_GE(strata[stratum], 5) << stratum;  // people have all of these without being asked
}

TEST(DrawScene, EveryStratumIsWhatItSays) {
  for (const auto& stratum : known_strata())
    for (Seed seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE(stratum.name + std::to_string(seed));
      DrawOptions options;
      options.strata = {stratum.name};
      const DrawnScene drawn = draw_scene(options, seed);
      expect_valid(drawn);
      const auto found = strata_of(drawn);
      EXPECT_NE(std::find(found.begin(), found.end(), stratum.name), found.end());
    }
}

TEST(DrawScene, SameSeedSameBytesAndAnOptionChangesNothingElse) {
  EXPECT_EQ(scene_toml(draw_scene({}, 5)), scene_toml(draw_scene({}, 5)));
  DrawOptions options;
  options.sensors = 8;
  const DrawnScene plain = draw_scene({}, 5), eight = draw_scene(options, 5);
  EXPECT_EQ(eight.rig.size(), 8u);
  EXPECT_EQ(eight.body.waist_m, plain.body.waist_m);
  EXPECT_EQ(eight.garments[0].print.colors, plain.garments[0].print.colors);
  EXPECT_EQ(eight.rig[0].place.distance_m, plain.rig[0].place.distance_m);
}

TEST(DrawScene, OptionsAreKept) {
  DrawOptions options;
  options.people = "man";
  options.clothes = "shorts";
  options.prints = "busy";
  options.sensor_model = "kinect_v1";
  for (Seed seed = 1; seed <= 20; ++seed) {
    const DrawnScene drawn = draw_scene(options, seed);
    expect_valid(drawn);
    EXPECT_EQ(drawn.body.sex, "male");
    EXPECT_EQ(drawn.garments[1].name, "shorts");
    EXPECT_GE(drawn.garments[1].print.colors.size(), 4u);
    EXPECT_EQ(drawn.rig[0].spec.calibration.ir.width, 640);
  }
}

std::string error_of(const DrawOptions& options) {
  try {
    draw_scene(options, 1);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(DrawScene, WhatExcludesItselfIsRefused) {
  DrawOptions options;
  options.strata = {"kilt"};
  EXPECT_NE(error_of(options).find("expected some of skirt, dress"), std::string::npos);
  options.strata = {"dress", "tucked"};
  EXPECT_NE(error_of(options).find("worn alone"), std::string::npos);
  options.strata = {"dress", "skirt"};
  EXPECT_FALSE(error_of(options).empty());
  options.strata = {"three_sensors"};
  options.sensors = 4;
  EXPECT_NE(error_of(options).find("expected 3 or 0"), std::string::npos);
  options.strata = {};
  options.sensors = 2;
  EXPECT_NE(error_of(options).find("3 to 8"), std::string::npos);
  options.sensors = 0;
  options.sensor_model = "kinect_v9";
  EXPECT_NE(error_of(options).find("expected one of"), std::string::npos);
}

}  // namespace
}  // namespace dressform
