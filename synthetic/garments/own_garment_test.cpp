#include "synthetic/garments/own_garment.h"

#include <map>
#include <opencv2/imgcodecs.hpp>

#include "scenes/mesh_io.h"
#include "scenes/testing/mesh_files.h"
#include "synthetic/garments/garment.h"

namespace dressform {
namespace {

using testing::HasSubstr;

// Someone's shirt: a tube about the trunk with a texture, 0.95 to 1.5 m above the floor.
TexturedMesh shirt(int around = 48, int rows = 12) {
  TexturedMesh result = tube(around, rows);
  for (Vector3d& v : result.mesh.vertices) {
    const double t = (1 - v.y()) / 0.1 * 3 / rows;  // 0 at the top
    v = {0.9 * v.x(), 1.5 - 0.55 * t, 0.75 * v.z()};
  }
  return result;
}

class OwnGarments : public FilesTest {
 protected:
  static void SetUpTestSuite() { body_ = new Body(make_body({})); }
  static void TearDownTestSuite() {
    delete body_;
    body_ = nullptr;
  }
  GarmentSpec spec(const TexturedMesh& mesh, const char* kind = "shirt") const {
    GarmentSpec result;
    result.kind = kind;
    result.slot = std::string(kind) == "shirt" || std::string(kind) == "dress" ? "top" : "bottom";
    result.mesh = file("own.obj");
    write_obj(result.mesh, mesh);
    return result;
  }
  static Garment worn(const GarmentSpec& spec) { return make_garment(spec, *body_, {}, 1); }
  static std::string refused(const GarmentSpec& spec) {
    return refusal([&] { worn(spec); });
  }
  static std::map<std::string, double> heights(const Garment& garment) {
    std::map<std::string, double> result;
    for (const auto& rim : garment.rims)
      for (const auto& p : rim.points) result[rim.name] += p.y() / static_cast<double>(rim.points.size());
    return result;
  }

  static Body* body_;
};
Body* OwnGarments::body_ = nullptr;

TexturedMesh moved(TexturedMesh mesh, const Eigen::Matrix3d& motion) {
  for (Vector3d& v : mesh.mesh.vertices) v = (motion * v).eval();
  return mesh;
}

TEST_F(OwnGarments, OtherUnitsAndAxesAreNamedAndBroughtToTheWorld) {
  Eigen::Matrix3d z_up;
  z_up << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const std::map<std::string, double> units{{"dm", 10}, {"cm", 100}, {"mm", 1000}, {"inch", 1 / 0.0254}};
  for (const auto& [unit, scale] : units)
    for (const bool z : {false, true}) {
      GarmentSpec own = spec(moved(shirt(), scale * (z ? z_up : Eigen::Matrix3d::Identity())));
      const std::string said = std::string("(unit = \"") + unit + "\", up = \"" + (z ? "z" : "y") + "\")";
      EXPECT_THAT(refused(own), HasSubstr(said)) << refused(own);
      EXPECT_THAT(refused(own), HasSubstr("own.obj: found a shirt"));
      own.frame.unit = unit;
      own.frame.up = z ? "z" : "y";
      const auto found = heights(worn(own));
      EXPECT_NEAR(found.at("neck"), 1.5, 1e-6);
      EXPECT_NEAR(found.at("hem"), 0.95, 1e-6);
    }
  GarmentSpec own = spec(moved(shirt(), z_up));
  EXPECT_THAT(refused(own), HasSubstr("metres with z up"));
  own = spec(shirt());
  own.frame.lift_m = 2;
  EXPECT_THAT(refused(own), HasSubstr("expected it on the body"));
  EXPECT_THAT(refused(spec(moved(shirt(), 0.01 * Eigen::Matrix3d::Identity()))), HasSubstr("own.obj"));
}

TEST_F(OwnGarments, ButtonsPocketsAndLiningsAreNoRims) {
  TexturedMesh mesh = shirt();
  const auto add = [&](const TexturedMesh& other, const Vector3d& size, const Vector3d& at) {
    const int first = static_cast<int>(mesh.mesh.vertices.size());
    for (const Vector3d& v : other.mesh.vertices) mesh.mesh.vertices.push_back(v.cwiseProduct(size) + at);
    for (const Vector3i& t : other.mesh.triangles) mesh.mesh.triangles.push_back(t + Vector3i::Constant(first));
    mesh.corner_uv.insert(mesh.corner_uv.end(), other.corner_uv.begin(), other.corner_uv.end());
  };
  for (double y : {1.0, 1.1, 1.2, 1.3}) add(tube(8, 1), {0.02, 0.02, 0.02}, {0, y, 0.27});  // buttons
  add(shirt(), {0.9, 0.98, 0.9}, {0, 0.02, 0});                                             // a lining
  const Garment garment = worn(spec(mesh));
  const auto found = heights(garment);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found.at("neck"), 1.5, 1e-6);
  EXPECT_NEAR(found.at("hem"), 0.95, 1e-6);
  EXPECT_EQ(garment.textured.mesh.triangles.size(), mesh.mesh.triangles.size()) << "all of it is worn";
}

TEST_F(OwnGarments, ASlitBetweenNeckAndHemIsNeither) {
  TexturedMesh mesh = shirt();
  std::size_t to = 0;
  for (std::size_t t = 0; t < mesh.mesh.triangles.size(); ++t) {
    Vector3d middle = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) middle += mesh.mesh.vertices[mesh.mesh.triangles[t][k]] / 3;
    if (std::abs(middle.x()) < 0.06 && middle.z() > 0 && middle.y() > 1.2 && middle.y() < 1.3) continue;
    mesh.mesh.triangles[to] = mesh.mesh.triangles[t];
    mesh.corner_uv[to++] = mesh.corner_uv[t];
  }
  mesh.mesh.triangles.resize(to);
  mesh.corner_uv.resize(to);
  const auto found = heights(worn(spec(mesh)));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found.at("neck"), 1.5, 1e-6);
  EXPECT_NEAR(found.at("hem"), 0.95, 1e-6);
  EXPECT_EQ(found.count("opening_2"), 1u);
}

TEST_F(OwnGarments, WhatIsNoGarmentIsRefusedWithCountAndPlace) {
  TexturedMesh open = shirt();  // open in front, from neck to hem
  std::size_t to = 0;
  for (std::size_t t = 0; t < open.mesh.triangles.size(); ++t) {
    if (t / 2 % 48 == 0) continue;
    open.mesh.triangles[to] = open.mesh.triangles[t];
    open.corner_uv[to++] = open.corner_uv[t];
  }
  open.mesh.triangles.resize(to);
  open.corner_uv.resize(to);
  EXPECT_THAT(refused(spec(open)), HasSubstr("own.obj: found 1 openings of a shirt"));
  EXPECT_THAT(refused(spec(open)), HasSubstr("open in front"));

  TexturedMesh shell = shirt();  // two layers, joined at the rims
  const int rows = 13, around = 48, first = static_cast<int>(shell.mesh.vertices.size());
  for (int v = 0; v < first; ++v)
    shell.mesh.vertices.push_back(shell.mesh.vertices[v].cwiseProduct(Vector3d(0.98, 1, 0.98)));
  const auto triangles = shell.mesh.triangles;
  for (const Vector3i& t : triangles) shell.mesh.triangles.emplace_back(first + t[0], first + t[2], first + t[1]);
  for (int row : {0, rows - 1})
    for (int i = 0; i < around; ++i) {
      const int a = row * around + i, b = row * around + (i + 1) % around;
      shell.mesh.triangles.emplace_back(a, first + b, b);
      shell.mesh.triangles.emplace_back(a, first + a, first + b);
    }
  shell.corner_uv.resize(shell.mesh.triangles.size(), {Vector2f(0, 0), Vector2f(1, 0), Vector2f(0, 1)});
  EXPECT_THAT(refused(spec(shell)), HasSubstr("two layers"));

  TexturedMesh panels = shirt();  // four panels, 2 mm apart
  TexturedMesh apart;
  for (std::size_t t = 0; t < panels.mesh.triangles.size(); ++t) {
    const int panel = static_cast<int>(t / 2 % 48) / 12;
    const Vector3d aside = 0.001 * Vector3d(panel < 2 ? 1 : -1, 0, panel % 3 == 0 ? 1 : -1);
    const int at = static_cast<int>(apart.mesh.vertices.size());
    for (int k = 0; k < 3; ++k)
      apart.mesh.vertices.push_back(panels.mesh.vertices[panels.mesh.triangles[t][k]] + aside);
    apart.mesh.triangles.emplace_back(at, at + 1, at + 2);
    apart.corner_uv.push_back(panels.corner_uv[t]);
  }
  apart.texture = panels.texture;
  EXPECT_THAT(refused(spec(apart)), HasSubstr("4 pieces that only touch"));
  EXPECT_THAT(refused(spec(shirt(), "trousers")), HasSubstr("expected waist, left_ankle, right_ankle"));
}

}  // namespace
}  // namespace dressform
