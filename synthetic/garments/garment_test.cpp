#include "synthetic/garments/garment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/core.hpp>
#include <set>

#include "scenes/error.h"
#include "scenes/mesh_io.h"
#include "synthetic/garments/drape/cloth.h"
#include "synthetic/garments/print.h"
#include "synthetic/geometry/self_intersection.h"
#include "synthetic/geometry/surface_distance.h"

namespace dressform {
namespace {

GarmentSpec garment(const std::string& kind, double sleeve_or_length, const std::string& print = "plain") {
  GarmentSpec spec;
  spec.kind = kind;
  spec.slot = kind == "shirt" ? "top" : "bottom";
  spec.sleeve = spec.length = sleeve_or_length;
  spec.ease_m = 0.08;
  spec.print.kind = print;
  spec.cloth_edge_m = 0.010;  // coarser than usual, for time
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

BodySpec sampled(const std::string& who, int seed) {
  BodySpec spec;
  spec.sample = who;
  spec.sample_seed = seed;
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

void expect_well_cut(const Garment& garment, const std::vector<std::string>& names) {
  const Mesh& mesh = garment.textured.mesh;
  const Topology shape = topology(mesh);
  EXPECT_EQ(shape.components, 1);
  EXPECT_EQ(shape.non_manifold_edges, 0);
  EXPECT_EQ(shape.loops, static_cast<int>(names.size()));
  EXPECT_EQ(shape.euler(), 2 - static_cast<int>(names.size()));  // genus 0
  EXPECT_EQ(shape.boundary_edges, 2 * shape.vertices - shape.triangles - 2 * shape.euler());
  std::set<std::array<double, 3>> rim_vertices;
  for (const auto& loop : boundary_loops(mesh))
    for (int i : loop) rim_vertices.insert({mesh.vertices[i].x(), mesh.vertices[i].y(), mesh.vertices[i].z()});
  ASSERT_EQ(garment.rims.size(), names.size());
  size_t points = 0;
  for (size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(garment.rims[i].name, names[i]);
    points += garment.rims[i].points.size();
    for (const Vector3d& p : garment.rims[i].points) EXPECT_TRUE(rim_vertices.count({p.x(), p.y(), p.z()}));
  }
  EXPECT_EQ(points, rim_vertices.size());
}

// Every vertex, edge middle and triangle middle.
void expect_clear(const Mesh& cloth, const Mesh& surface, double clearance_m) {
  const SurfaceDistance tree(surface);
  double worst = 1;
  const auto look = [&](const Vector3d& p) {
    const auto near = tree.closest(p, 0.03);
    if (!near.found) return;
    worst = std::min(worst, near.height);
  };
  for (const Vector3i& t : cloth.triangles) {
    const Vector3d &a = cloth.vertices[t[0]], &b = cloth.vertices[t[1]], &c = cloth.vertices[t[2]];
    for (const Vector3d& p : {a, Vector3d(0.5 * (a + b)), Vector3d((a + b + c) / 3)}) look(p);
  }
  EXPECT_GE(worst, clearance_m);
}

// Lies as cloth does: hardly stretched against its pattern, and nothing meets anything (exact predicates).
void expect_at_rest(const Garment& garment, const Mesh& body, const Mesh& under) {
  const Mesh& mesh = garment.textured.mesh;
  Cloth cloth;
  cloth.features = features_of(mesh.triangles);
  cloth.rest_m = garment.rest_m;
  ASSERT_EQ(cloth.rest_m.size(), cloth.features.edges.size());
  EXPECT_LE(strain_quantile(cloth, mesh.vertices, 0.95), 0.05);
  EXPECT_GT(strain_quantile(cloth, mesh.vertices, 0.95), 0.001);  // it did move
  EXPECT_EQ(self_intersections(mesh), 0);
  EXPECT_TRUE(crossing_triangles(mesh, body).empty());
  EXPECT_TRUE(crossing_triangles(mesh, under).empty());
}

void expect_readable(const TexturedMesh& textured) {
  ASSERT_EQ(textured.corner_uv.size(), textured.mesh.triangles.size());
  ASSERT_FALSE(textured.texture.empty());
  double mirrored = 0, all = 0;
  for (size_t i = 0; i < textured.corner_uv.size(); ++i) {
    const auto& uv = textured.corner_uv[i];
    for (const Vector2f& q : uv) {
      ASSERT_GE(q.minCoeff(), 0.f);
      ASSERT_LE(q.maxCoeff(), 1.f);
    }
    const Vector2f a = uv[1] - uv[0], b = uv[2] - uv[0];
    const Vector3i& t = textured.mesh.triangles[i];
    const auto& v = textured.mesh.vertices;
    const double area = (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]).norm();
    // Counter-clockwise seen from outside is clockwise where v grows downwards.
    if (a.x() * b.y() - a.y() * b.x() > 0) mirrored += area;
    all += area;
  }
  EXPECT_LT(mirrored, 0.01 * all);
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
}

const Outfit kOutfits[] = {
    {"group1", {}, garment("trousers", 0.96), garment("shirt", 0.42, "stars")},
    {"group3", {}, garment("trousers", 0.97, "denim"), garment("shirt", 0.96, "stripes")},
    {"group4", {}, garment("skirt", 0.48), garment("shirt", 0.42, "stars")},
    {"woman", woman(), garment("trousers", 0.5), garment("shirt", 0.3, "complex")},
    {"sampled_woman", sampled("woman", 3), garment("skirt", 0.7), garment("shirt", 0.9, "plaid")},
    {"sampled_man", sampled("man", 2), garment("trousers", 1.0), garment("shirt", 0.5)},
    {"stout_man", stout_man(), garment("trousers", 0.55), garment("shirt", 0.42)},
};
// A dress, a wedge-shaped neckline, a hem that rises to the front, a shirt tucked into trousers worn low.
TEST(Garment, IsCutAsAsked) {
  GarmentSpec dress = garment("dress", 0.3);
  dress.length = 0.6;
  dress.neck = "v";
  dress.neck_depth_m = 0.15;
  dress.hem_slant = 0.2;
  const Body lady = make_body(sampled("woman", 4));
  const Garment worn = make_garment(dress, lady, {}, 2);
  expect_well_cut(worn, {"neck", "left_cuff", "right_cuff", "hem"});
  expect_at_rest(worn, lady.mesh, {});
  expect_readable(worn.textured);
  const auto forward = [](const Vector3d& a, const Vector3d& b) { return a.z() < b.z(); };
  const auto [back, front] = std::minmax_element(worn.rims[3].points.begin(), worn.rims[3].points.end(), forward);
  EXPECT_GT(front->y(), back->y() + 0.02);
  dress.neck = "round";
  const auto lowest_at = [](const TruthRim& neck, double x) {
    double low = 9;
    for (const auto& p : neck.points)
      if (p.z() > -0.03 && std::abs(std::abs(p.x()) - x) < 0.012) low = std::min(low, p.y());
    return low;
  };
  // Half way out a round neckline is hardly higher than in the middle, a wedge is.
  const Garment round = make_garment(dress, lady, {}, 2);
  const double wedge_rise = lowest_at(worn.rims[0], 0.05) - lowest_at(worn.rims[0], 0);
  const double round_rise = lowest_at(round.rims[0], 0.05) - lowest_at(round.rims[0], 0);
  EXPECT_GT(wedge_rise, round_rise + 0.015);

  const Body man = make_body({});
  GarmentSpec shirt = garment("shirt", 0.4), trousers = garment("trousers", 0.9);
  shirt.tucked = true;
  trousers.waist_offset_m = -0.03;
  std::vector<Garment> layers{make_garment(shirt, man, {}, 2)};
  layers.push_back(make_garment(trousers, man, layers, 2));
  expect_well_cut(layers[0], {"neck", "left_cuff", "right_cuff", "hem"});
  expect_well_cut(layers[1], {"waist", "left_ankle", "right_ankle"});
  expect_at_rest(layers[0], man.mesh, {});
  expect_at_rest(layers[1], man.mesh, layers[0].textured.mesh);
  for (const auto& p : layers[1].rims[0].points) EXPECT_NEAR(p.y(), man.landmarks.waist - 0.045, 0.02);
  double hem = 0;
  for (const auto& p : layers[0].rims[3].points) hem = std::max(hem, p.y());
  EXPECT_LT(hem, man.landmarks.waist - 0.06);

  trousers.tucked = true;
  EXPECT_THROW(make_garment(trousers, man, {}, 2), InputError);
}

INSTANTIATE_TEST_SUITE_P(Garments, Outfits, testing::ValuesIn(kOutfits),
                         [](const auto& info) { return std::string(info.param.name); });

// Nowhere does a cuff run up into the sleeve or over to the trunk: it is cut straight, and waves by a centimetre or two
// as it hangs.
TEST(Garment, CuffsGoRoundTheArmAlone) {
  BodySpec spec;
  spec.arm_angle_deg = 16;
  const Body body = make_body(spec);
  for (const double sleeve : {0.45, 1.0}) {
    const Garment shirt = make_garment(garment("shirt", sleeve), body, {}, 1);
    for (const TruthRim& rim : shirt.rims) {
      if (rim.name != "left_cuff" && rim.name != "right_cuff") continue;
      const std::string side = rim.name == "left_cuff" ? "Left" : "Right";
      const Eigen::Vector3d shoulder = body.joints.at("Shoulder" + side), wrist = body.joints.at("Wrist" + side);
      const Eigen::Vector3d axis = (wrist - shoulder).normalized();
      double least = 1e9, most = -1e9;
      for (const auto& p : rim.points) {
        least = std::min(least, axis.dot(p - shoulder));
        most = std::max(most, axis.dot(p - shoulder));
      }
      EXPECT_LT(most - least, 0.025) << rim.name << " of a sleeve of " << sleeve;
    }
  }
}

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

TEST(Print, HasTheAskedSizeAndColours) {
  PrintSpec spec;
  for (const std::string kind :
       {"plain", "stars", "complex", "stripes", "plaid", "denim", "weave", "characters", "all_over", "noise"}) {
    spec.kind = kind;
    spec.colors = {"#204060", "#ffffff"};
    const cv::Mat picture = paint_print(spec, 0.5, 0.4, 1000, 5);
    EXPECT_EQ(picture.size(), cv::Size(500, 400)) << kind;
    EXPECT_EQ(cv::norm(picture, paint_print(spec, 0.5, 0.4, 1000, 5), cv::NORM_INF), 0) << kind;
    cv::Scalar mean, deviation;
    cv::meanStdDev(picture, mean, deviation);
    EXPECT_GT(mean[0], mean[2]) << kind;  // bluish ground, BGR
    EXPECT_GT(deviation[0], 0.5) << kind;
  }
  spec.kind = "zebra";
  EXPECT_THROW(paint_print(spec, 0.5, 0.4, 1000, 5), InputError);
  spec.kind = "plain";
  spec.colors = {"blue"};
  EXPECT_THROW(paint_print(spec, 0.5, 0.4, 1000, 5), InputError);
}

}  // namespace
}  // namespace dressform
