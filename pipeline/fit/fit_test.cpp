#include "pipeline/fit/fit.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "pipeline/body/body_landmarks.h"
#include "pipeline/fit/rbf_field.h"
#include "pipeline/garment/sleeves.h"
#include "pipeline/testing/figure.h"
#include "scenes/error.h"
#include "scenes/serialize.h"

namespace dressform {
namespace {

std::vector<Vector3d> cloud(int count) {
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) points.emplace_back(std::sin(i * 1.7), std::cos(i * 2.3), std::sin(i * 0.9 + 1));
  return points;
}

TEST(RbfField, ReproducesAnAffineMapEverywhere) {
  Eigen::Matrix3d a;
  a << 1.1, 0.1, 0, -0.2, 0.9, 0.05, 0, 0.1, 1.3;
  std::vector<Vector3d> targets;
  for (const auto& p : cloud(40)) targets.push_back(a * p + Vector3d(1, 2, 3));
  for (const auto kernel : {RbfField::Kernel::linear, RbfField::Kernel::cubic}) {
    const RbfField field(cloud(40), targets, kernel, 0.01);
    EXPECT_LT((field({5, -7, 9}) - a * Vector3d(5, -7, 9) - Vector3d(1, 2, 3)).norm(), 1e-8);
  }
}

TEST(RbfField, InterpolatesWithoutSmoothing) {
  auto targets = cloud(40);
  for (std::size_t i = 0; i < targets.size(); ++i) targets[i] += 0.1 * Vector3d(std::sin(i), std::cos(i * 3.0), 0.2);
  for (const auto kernel : {RbfField::Kernel::linear, RbfField::Kernel::cubic}) {
    const RbfField field(cloud(40), targets, kernel, 0);
    EXPECT_LT(field.largest_residual_m(), 1e-9);
    EXPECT_GT(RbfField(cloud(40), targets, kernel, 10).largest_residual_m(), 1e-3);
  }
}

TEST(RbfField, KernelsThatFallOffLeaveTheAffinePartAlone) {
  auto targets = cloud(40);
  for (auto& target : targets) target += Vector3d(0.5, 0, 0);
  targets[7] += Vector3d(0, 0.1, 0);
  for (const auto kernel : {RbfField::Kernel::gaussian, RbfField::Kernel::wendland}) {
    const RbfField field(cloud(40), targets, kernel, 0, 0.2);
    EXPECT_LT(field.largest_residual_m(), 1e-9);
    const Vector3d far = field({8, 0, 0}) - field({9, 0, 0}), further = field({80, 0, 0}) - field({81, 0, 0});
    EXPECT_LT((far - further).norm(), 1e-9);
  }
}

TEST(RbfField, UglyControls) {
  EXPECT_EQ(RbfField({}, {}, RbfField::Kernel::linear, 0)({1, 2, 3}), Vector3d(1, 2, 3));
  const RbfField one({{0, 0, 0}}, {{1, 0, 0}}, RbfField::Kernel::linear, 0);
  EXPECT_EQ(one({5, 5, 5}), Vector3d(6, 5, 5));
  std::vector<Vector3d> same(10, Vector3d(1, 1, 1)), flat, moved;
  EXPECT_TRUE(RbfField(same, same, RbfField::Kernel::linear, 0)({2, 2, 2}).isApprox(Vector3d(2, 2, 2)));
  for (auto p : cloud(20)) {
    p.z() = 0;
    flat.push_back(p);
    moved.push_back(2 * p);
  }
  EXPECT_LT((RbfField(flat, moved, RbfField::Kernel::linear, 0)({3, 4, 0}) - Vector3d(6, 8, 0)).norm(), 1e-8);
  EXPECT_THROW(RbfField(cloud(3), cloud(4), RbfField::Kernel::linear, 0), std::invalid_argument);
}

struct Try {
  KnownBody naked, user;
  TexturedGarments clothes;
  GarmentLayouts layouts;
};

Try make_try(const FigureSpec& user) {
  Try result;
  result.naked = known_body(make_figure({}));
  const Vector3d front(std::sin(user.yaw), 0, std::cos(user.yaw));
  result.user.body = make_figure(user);
  result.user.landmarks = with_front(find_landmarks(result.user.body, front), front);
  result.clothes.garments["top"] = make_tube(0.175, 1.02, 1.25);
  result.clothes.garments["bottom"] = make_tube(0.18, 0.5, 1.05);
  result.layouts["top"].kind = "shirt";
  result.layouts["bottom"].kind = "skirt";
  return result;
}

// Mean distance from the y axis of the vertices between two heights.
double mean_radius(const Mesh& mesh, double from, double to) {
  double sum = 0;
  int count = 0;
  for (const auto& v : mesh.vertices)
    if (v.y() > from && v.y() < to) sum += std::hypot(v.x(), v.z()), ++count;
  return sum / count;
}

TEST(Fit, EveryVariantKeepsTrianglesAndSurvives) {
  const Try input = make_try({1.65, 1.1, 18, 2.0});
  for (const auto& name : Fit::automatic_names()) {
    const auto result = Fit::at(name).run(input.naked, input.user, input.clothes, input.layouts, {}, 1);
    ASSERT_EQ(result.garments.size(), 2u) << name;
    for (const auto& [slot, garment] : result.garments) {
      const auto& before = input.clothes.garments.at(slot);
      EXPECT_EQ(garment.mesh.triangles, before.mesh.triangles) << name;
      EXPECT_EQ(garment.corner_uv, before.corner_uv) << name;
      for (const auto& v : garment.mesh.vertices) ASSERT_TRUE(v.allFinite()) << name;
    }
    EXPECT_EQ(to_bytes(result),
              to_bytes(Fit::at(name).run(input.naked, input.user, input.clothes, input.layouts, {}, 1)))
        << name;
  }
}

TEST(Fit, TheSameBodyTurnedLeavesTheClothesInPlace) {
  const Try input = make_try({1.8, 1, 15, 2.0});
  const auto result = Fit::at("rbf").run(input.naked, input.user, input.clothes, input.layouts, {}, 1);
  EXPECT_LT(result.body_rms_m, 0.004);
  for (const auto& [slot, garment] : result.garments) {
    const auto& before = input.clothes.garments.at(slot).mesh;
    const Eigen::AngleAxisd turn(2.0, Vector3d::UnitY());
    double worst = 0;
    for (std::size_t v = 0; v < before.vertices.size(); ++v)
      worst = std::max(worst, (garment.mesh.vertices[v] - turn * before.vertices[v]).norm());
    EXPECT_LT(worst, 0.03) << slot;  // a turn of some degrees shows most on a round trunk
  }
  EXPECT_EQ(result.foldovers, 0);
}

TEST(Fit, KeepsTheEaseOnAMuchWiderBody) {
  const Try input = make_try({1.7, 1.25, 15, -1.0});
  const auto result = Fit::at("rbf").run(input.naked, input.user, input.clothes, input.layouts, {}, 1);
  EXPECT_LT(result.body_rms_m, 0.006);
  const double grown = mean_radius(result.garments.at("top").mesh, 1.05, 1.12) - 0.15 * 1.25;
  EXPECT_NEAR(2 * M_PI * grown, 2 * M_PI * 0.025, 0.012);
  // Without it the map scales the offset too.
  const auto scaled = Fit::at("rbf").run(input.naked, input.user, input.clothes, input.layouts,
                                         {{"keep_offset", 0.0}, {"ease_rounds", 0}}, 1);
  EXPECT_GT(mean_radius(scaled.garments.at("top").mesh, 1.05, 1.12) - 0.15 * 1.25, grown);
}

// A tube about an arm of the figure, by its upper end's height; its triangles are added behind the garment's.
void add_sleeve(const FigureSpec& figure, double side, double radius_m, Mesh& garment) {
  const double slope = std::tan(figure.arm_deg * M_PI / 180);
  Mesh sleeve = make_tube(radius_m, 0.95, 1.2).mesh;
  const int offset = static_cast<int>(garment.vertices.size());
  for (auto v : sleeve.vertices) {
    v.x() += side * (0.20 * figure.breadth + (1.40 - v.y()) * slope);
    garment.vertices.push_back(v);
  }
  for (const auto& t : sleeve.triangles) garment.triangles.emplace_back(t + Vector3i::Constant(offset));
}

TEST(Fit, WideSleevesBesideTheTrunkAreNotItsCloth) {
  // The user's arms hang closer: the sleeves' inner sides come nearer to the trunk than to the arms.
  const FigureSpec naked{}, user{1.75, 1.15, 11, 0};
  Try input = make_try(user);
  TexturedMesh& top = input.clothes.garments["top"];
  const std::size_t of_trunk = top.mesh.vertices.size();
  for (const double side : {-1.0, 1.0}) add_sleeve(naked, side, 0.085, top.mesh);
  top.corner_uv.resize(top.mesh.triangles.size(), top.corner_uv[0]);
  GarmentLayout& layout = input.layouts["top"];
  layout = with_sleeve_ends(layout, top.mesh, input.naked.landmarks);
  for (LimbCover& arm : layout.arms) arm.covered = true;
  const auto result = Fit::at("rbf").run(input.naked, input.user, input.clothes, input.layouts, {}, 1);
  Mesh trunk = result.garments.at("top").mesh;
  trunk.vertices.resize(of_trunk);
  EXPECT_NEAR(2 * M_PI * (mean_radius(trunk, 1.05, 1.12) - 0.15 * 1.15), 2 * M_PI * 0.025, 0.006);
}

// Wider by a quarter: the clothes go with the body under any of the maps.
TEST(Fit, EveryMapTakesBodyAndClothesToAWiderUser) {
  const Try input = make_try({1.7, 1.25, 15, -1.0});
  const std::vector<std::pair<std::string, FieldValues>> maps{{"rbf", {{"kernel", "gaussian"}}},
                                                              {"rbf", {{"kernel", "wendland"}}},
                                                              {"ffd", {}},
                                                              {"volumetric", {}},
                                                              {"arap", {}}};
  for (const auto& [name, values] : maps) {
    const auto result = Fit::at(name).run(input.naked, input.user, input.clothes, input.layouts, values, 1);
    EXPECT_LT(result.body_rms_m, 0.015) << name;  // the trunk alone is 37 mm off before
    EXPECT_GT(result.control_points, 200) << name;
    EXPECT_NEAR(mean_radius(result.garments.at("top").mesh, 1.05, 1.12), 0.175 * 1.25, 0.02) << name;
  }
}

TEST(Fit, TheNumberOfThreadsDoesNotMatter) {
  const Try input = make_try({1.65, 1.1, 18, 2.0});
  const auto both = to_bytes(Fit::at("rbf").run(input.naked, input.user, input.clothes, input.layouts, {}, 1));
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(both, to_bytes(Fit::at("rbf").run(input.naked, input.user, input.clothes, input.layouts, {}, 1)));
}

TEST(Fit, UniformScalesByTheShoulderHeight) {
  const Try input = make_try({0.9 * 1.8, 1, 15, 0});
  const auto result = Fit::at("uniform").run(input.naked, input.user, input.clothes, input.layouts, {}, 1);
  EXPECT_NEAR(mean_radius(result.garments.at("top").mesh, 0, 2), 0.9 * 0.175, 0.006);
}

TEST(Fit, MissingInputIsNamed) {
  Try input = make_try({});
  const TexturedGarments none;
  EXPECT_TRUE(Fit::at("rbf").run(input.naked, input.user, none, {}, {}, 1).garments.empty());
  EXPECT_THROW(Fit::at("rbf").run(input.naked, input.user, input.clothes, {}, {}, 1), InputError);
  input.user = {};
  for (const auto& name : Fit::automatic_names())
    EXPECT_THROW(Fit::at(name).run(input.naked, input.user, input.clothes, input.layouts, {}, 1), InputError) << name;
}

}  // namespace
}  // namespace dressform
