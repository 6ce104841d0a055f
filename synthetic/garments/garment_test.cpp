#include "synthetic/garments/garment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <opencv2/core.hpp>
#include <set>

#include "scenes/error.h"
#include "scenes/mesh_io.h"
#include "synthetic/garments/garment_checks.h"

namespace dressform {
namespace {

GarmentSpec with_collar(GarmentSpec spec, const std::string& collar) {
  spec.collar = collar;
  return spec;
}

BodySpec woman() {
  BodySpec spec;
  spec.sex = "female";
  spec.stature_m = 1.64;
  spec.chest_m = 0.95;
  spec.waist_m = 0.80;
  spec.hip_m = 1.02;
  return spec;
}

BodySpec stout_man() {
  BodySpec spec;
  spec.stature_m = 1.73;
  spec.chest_m = 1.13;
  spec.waist_m = 1.02;
  spec.hip_m = 1.07;
  spec.arm_angle_deg = 20;
  return spec;
}

struct Outfit {
  const char* name;
  BodySpec body;
  GarmentSpec bottom, top;
};

class Outfits : public testing::TestWithParam<Outfit> {};

// A polo collar rises about the neck and comes down again outside; a hood covers the crown and leaves the face free.
void expect_collar(const Garment& top, const std::string& collar, const Body& body) {
  const auto& cloth = top.textured.mesh.vertices;
  const auto& rim = top.rims[0].points;
  const auto part = [](const std::vector<Vector3d>& points, const auto& keep) {
    std::vector<Vector3d> kept;
    std::copy_if(points.begin(), points.end(), std::back_inserter(kept), keep);
    return kept;
  };
  if (collar == "polo") {
    const auto behind = [](const Vector3d& p) { return p.z() < -0.06; };
    EXPECT_LT(highest(part(rim, behind)), highest(part(cloth, behind)) - 0.025);
    EXPECT_LT(highest(cloth), body.landmarks.neck + 0.10);
    const auto slit = [](const Vector3d& p) { return std::abs(p.x()) < 0.03 && p.z() > 0; };
    EXPECT_LT(lowest(part(rim, slit)), lowest(part(rim, behind)) - 0.05);
  } else {
    EXPECT_GT(highest(cloth), body.landmarks.stature);
    EXPECT_GT(highest(rim), body.landmarks.stature - 0.09);  // above the eyes
    const auto face = [&](const Vector3d& p) {               // eyes to throat
      return std::abs(p.x()) < 0.03 && p.z() > 0.02 && p.y() < body.landmarks.stature - 0.09 &&
             p.y() > body.landmarks.neck + 0.02;
    };
    EXPECT_TRUE(part(cloth, face).empty());
  }
}

TEST_P(Outfits, FitOutsideTheBodyWithExactRims) {
  const Outfit& outfit = GetParam();
  const Body body = make_body(outfit.body);
  std::vector<Garment> worn{make_garment(outfit.bottom, body, {}, 7)};
  worn.push_back(make_garment(outfit.top, body, worn, 7));
  if (outfit.bottom.kind == "trousers")
    expect_well_cut(worn[0], {"waist", "left_ankle", "right_ankle"});
  else
    expect_well_cut(worn[0], {"waist", "hem"});
  expect_well_cut(worn[1], {"neck", "left_cuff", "right_cuff", "hem"});
  expect_at_rest(worn[0], body.mesh, {});
  expect_at_rest(worn[1], body.mesh, worn[0].textured.mesh);
  for (const Garment& each : worn) {
    expect_clear(each.textured.mesh, body.mesh, 0.002);
    expect_readable(each.textured);
  }
  if (outfit.top.collar != "none") expect_collar(worn[1], outfit.top.collar, body);
}

const Outfit kOutfits[] = {
    {"group1", {}, garment("trousers", 0.96), with_collar(garment("shirt", 0.42, "stars"), "polo")},
    {"group3", {}, garment("trousers", 0.97, "denim"), with_collar(garment("shirt", 0.96, "stripes"), "hood")},
    {"group4", {}, garment("skirt", 0.48), garment("shirt", 0.42, "stars")},
    {"woman", woman(), garment("trousers", 0.5), with_collar(garment("shirt", 0.3, "complex"), "polo")},
    {"sampled_woman", sampled("woman", 3), garment("skirt", 0.7), with_collar(garment("shirt", 0.9, "plaid"), "hood")},
    {"sampled_man", sampled("man", 2), garment("trousers", 1.0), with_collar(garment("shirt", 0.5), "polo")},
    {"stout_man", stout_man(), garment("trousers", 0.55), with_collar(garment("shirt", 0.42), "hood")},
};

INSTANTIATE_TEST_SUITE_P(Garments, Outfits, testing::ValuesIn(kOutfits),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Garment, IsTheSameForTheSameSeed) {
  const Body body = make_body({});
  const GarmentSpec spec = garment("skirt", 0.4);
  const Garment a = make_garment(spec, body, {}, 3), b = make_garment(spec, body, {}, 3),
                c = make_garment(spec, body, {}, 4);
  EXPECT_EQ(a.textured.mesh.vertices, b.textured.mesh.vertices);
  EXPECT_EQ(cv::norm(a.textured.texture, b.textured.texture, cv::NORM_INF), 0);
  EXPECT_NE(a.textured.mesh.vertices, c.textured.mesh.vertices);
  EXPECT_THROW(make_garment(garment("cape", 1), body, {}, 3), InputError);
}

TEST(Garment, OwnMeshIsPlacedAsGivenAndItsRimsNamed) {
  const Body body = make_body({});
  const Garment made = make_garment(garment("trousers", 0.9), body, {}, 3);
  const auto file = std::filesystem::path(testing::TempDir()) / "someones_trousers.glb";
  write_glb(file, made.textured);
  GarmentSpec spec = garment("trousers", 1);
  spec.mesh = file;
  const Garment read = make_garment(spec, body, {}, 3);
  EXPECT_EQ(read.textured.mesh.triangles.size(), made.textured.mesh.triangles.size());
  ASSERT_EQ(read.rims.size(), 3u);
  std::set<std::string> names;
  for (const TruthRim& rim : read.rims) names.insert(rim.name);
  EXPECT_EQ(names, (std::set<std::string>{"waist", "left_ankle", "right_ankle"}));
}

}  // namespace
}  // namespace dressform
