#include "pipeline/correct/correct.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/garment/sleeves.h"
#include "pipeline/geometry/intersections.h"
#include "pipeline/geometry/mesh_query.h"
#include "pipeline/testing/figure.h"
#include "scenes/error.h"
#include "scenes/serialize.h"
#include "scenes/small_solvers.h"

namespace dressform {
namespace {

TEST(Intersections, KnownTriangles) {
  Mesh fixed;
  fixed.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  fixed.triangles = {{0, 1, 2}};
  const IntersectionFinder finder(fixed);
  EXPECT_EQ(finder.cut_by({0.2, 0.2, -1}, {0.2, 0.2, 1}, {0.3, 0.2, 1}), std::vector<int>{0});
  EXPECT_TRUE(finder.cut_by({0.2, 0.2, 1e-300}, {0.4, 0.2, 1}, {0.3, 0.2, 1}).empty());
  EXPECT_EQ(finder.cut_by({0.2, 0.2, 0}, {0.4, 0.2, 1}, {0.3, 0.2, 1}), std::vector<int>{0});  // touching counts
  EXPECT_TRUE(finder.cut_by({0.2, 0.2, 0}, {0.2, 0.2, 0}, {0.2, 0.2, 0}).empty());
  EXPECT_TRUE(IntersectionFinder(Mesh{}).cut_by({0, 0, 0}, {1, 0, 0}, {0, 1, 0}).empty());
}

TEST(Sleeves, EndWhereTheGarmentNoLongerEnclosesTheArm) {
  const Landmarks limbs = find_landmarks(make_figure({}));
  ASSERT_TRUE(limbs.left_arm);
  const Mesh upright = make_tube(0.07, 0, 0.30).mesh;  // along +y
  const auto onto = rotation_between(Vector3d::UnitY(), limbs.left_arm->direction);
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = onto;
  motion.translation() = limbs.left_arm->root;
  const auto ends = sleeve_ends(transformed(upright, motion.matrix()), limbs);
  EXPECT_NEAR(ends[0], 0.30, 0.05);
  EXPECT_EQ(ends[1], 0);
  // The same sleeve, above its last 12 cm one with the trunk's cloth: open towards the trunk.
  Mesh joined = upright;
  joined.triangles.clear();
  const Vector3d towards_trunk = onto.inverse() * -limbs.outwards(0);
  for (const auto& t : upright.triangles) {
    const Vector3d& v = upright.vertices[t[0]];
    if (v.y() > 0.18 || (v - v.y() * Vector3d::UnitY()).dot(towards_trunk) < 0) joined.triangles.push_back(t);
  }
  EXPECT_NEAR(sleeve_ends(transformed(compacted(joined), motion.matrix()), limbs)[0], 0.30, 0.05);
}

struct Case {
  KnownBody user;
  FittedGarments fitted;

  // A top whose sleeves end where its cloth does.
  void put_on(const TexturedMesh& top) {
    fitted.garments["top"] = top;
    fitted.layouts["top"].kind = "shirt";
    fitted.layouts["top"] = with_sleeve_ends(fitted.layouts["top"], top.mesh, user.landmarks);
  }
};

// A tube that dives into the figure's trunk all round, and one whose large triangles cut it between their vertices.
Case penetrating() {
  Case result;
  result.user = known_body(make_figure({}));
  result.put_on(make_tube(0.147, 1.02, 1.25, 0.008));
  TexturedMesh coarse;
  for (int row = 0; row < 2; ++row)
    for (int i = 0; i < 8; ++i) {
      const double angle = 2 * M_PI * i / 8;  // 0.158 at the corners, 0.146 at the middles of the sides
      coarse.mesh.vertices.emplace_back(0.158 * std::sin(angle), 1.2 - 0.15 * row, 0.158 * std::cos(angle));
    }
  for (int i = 0; i < 8; ++i) {
    coarse.mesh.triangles.emplace_back(i, 8 + i, 8 + (i + 1) % 8);
    coarse.mesh.triangles.emplace_back(i, 8 + (i + 1) % 8, (i + 1) % 8);
  }
  coarse.corner_uv.assign(16, {Vector2f(0, 0), Vector2f(0, 1), Vector2f(1, 1)});
  coarse.texture = cv::Mat(2, 2, CV_8UC3, cv::Scalar(1, 2, 3));
  result.fitted.garments["bottom"] = coarse;
  result.fitted.layouts["bottom"].kind = "skirt";
  return result;
}

TEST(Correct, SmoothVariantLeavesNothingThatIntersects) {
  const Case input = penetrating();
  for (const auto& [name, garment] : input.fitted.garments)
    ASSERT_FALSE(intersecting_pairs(garment.mesh, input.user.body).empty()) << name;
  const auto result = Correct::at("signed_distance_smooth").run(input.user, input.fitted, {}, 1);
  const MeshQuery body(input.user.body);
  for (const auto& [name, garment] : result.garments) {
    EXPECT_EQ(result.intersecting_pairs.at(name), 0) << name;
    EXPECT_TRUE(result.converged.at(name)) << name;
    EXPECT_TRUE(intersecting_pairs(garment.mesh, input.user.body).empty()) << name;
    EXPECT_GT(result.moved_vertices.at(name), 0);
    EXPECT_LT(result.largest_move_m.at(name), 0.03) << name;
    for (const auto& v : garment.mesh.vertices) EXPECT_GT(body.signed_distance(v), 0.0025) << name;
  }
}

TEST(Correct, ClothThatTouchesNothingIsLeftAlone) {
  Case input = penetrating();
  input.fitted.garments.clear();
  input.put_on(make_tube(0.17, 1.02, 1.2));
  for (const auto& name : Correct::automatic_names()) {
    const auto result = Correct::at(name).run(input.user, input.fitted, {}, 1);
    EXPECT_EQ(result.garments.at("top").mesh.vertices, input.fitted.garments.at("top").mesh.vertices) << name;
    EXPECT_EQ(result.moved_vertices.at("top"), 0) << name;
  }
}

TEST(Correct, EveryVariantPushesOutwardsAndRepeats) {
  const Case input = penetrating();
  const MeshQuery body(input.user.body);
  for (const auto& name : Correct::automatic_names()) {
    const auto result = Correct::at(name).run(input.user, input.fitted, {}, 1);
    const auto& before = input.fitted.garments.at("top").mesh;
    const auto& after = result.garments.at("top").mesh;
    EXPECT_EQ(after.triangles, before.triangles) << name;
    int inside_before = 0, inside_after = 0;
    for (const auto& v : before.vertices) inside_before += body.signed_distance(v) < 0;
    for (const auto& v : after.vertices) inside_after += body.signed_distance(v) < 0;
    EXPECT_LT(inside_after, inside_before / 20) << name;
    EXPECT_EQ(result.intersecting_pairs.at("top"), static_cast<int>(intersecting_pairs(after, input.user.body).size()))
        << name;
    EXPECT_EQ(to_bytes(result), to_bytes(Correct::at(name).run(input.user, input.fitted, {}, 1))) << name;
  }
}

// A tube 0.25 m long about the arm's axis, from its root on, then shifted.
TexturedMesh sleeve_of(const Limb& arm, double radius_m, const Vector3d& shift) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = rotation_between(Vector3d::UnitY(), arm.direction);
  motion.translation() = arm.root + shift;
  TexturedMesh sleeve = make_tube(radius_m, 0, 0.25);
  sleeve.mesh = transformed(sleeve.mesh, motion.matrix());
  return sleeve;
}

TEST(Correct, SleeveFarOffItsArmComesBackRoundIt) {
  Case input = penetrating();
  input.fitted.garments.clear();
  const Landmarks& limbs = input.user.landmarks;
  ASSERT_TRUE(limbs.left_arm);
  const TexturedMesh sleeve = sleeve_of(*limbs.left_arm, 0.055, 0.08 * limbs.left_arm->direction + 0.035 * limbs.front);
  input.put_on(sleeve);
  const auto result = Correct::at("signed_distance_smooth").run(input.user, input.fitted, {}, 1);
  EXPECT_EQ(result.intersecting_pairs.at("top"), 0);
  const auto ends = sleeve_ends(result.garments.at("top").mesh, limbs);
  EXPECT_EQ(ends, sleeve_ends(sleeve.mesh, limbs));
}

double longest_side(const Mesh& mesh) {
  double longest = 0;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, (mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]).norm());
  return longest;
}

TEST(Correct, CrumpledClothIsNotDrawnOut) {
  // A sleeve crumpled into its arm: triangles stand across the arm, whichever way they are lifted.
  Case input = penetrating();
  input.fitted.garments.clear();
  const Landmarks& limbs = input.user.landmarks;
  ASSERT_TRUE(limbs.left_arm);
  TexturedMesh sleeve = sleeve_of(*limbs.left_arm, 0.055, 0.08 * limbs.left_arm->direction);
  for (std::size_t v = 0; v < sleeve.mesh.vertices.size(); ++v) {
    const double i = static_cast<double>(v);
    sleeve.mesh.vertices[v] += 0.020 * Vector3d(std::sin(12.9 * i), 0.3 * std::sin(78.2 * i), std::sin(37.7 * i));
  }
  input.put_on(sleeve);
  ASSERT_GT(intersecting_pairs(sleeve.mesh, input.user.body).size(), 500u);
  const auto result = Correct::at("signed_distance_smooth").run(input.user, input.fitted, {}, 1);
  EXPECT_EQ(result.intersecting_pairs.at("top"), 0);
  EXPECT_LT(longest_side(result.garments.at("top").mesh), 3 * longest_side(sleeve.mesh));
}

TEST(Correct, UglyInput) {
  Case input = penetrating();
  FittedGarments none;
  none.garments["top"] = {};
  none.layouts["top"].kind = "shirt";
  for (const auto& name : Correct::automatic_names()) {
    EXPECT_TRUE(Correct::at(name).run(input.user, none, {}, 1).garments.at("top").mesh.vertices.empty()) << name;
    EXPECT_THROW(Correct::at(name).run(KnownBody{}, input.fitted, {}, 1), InputError) << name;
  }
}

}  // namespace
}  // namespace dressform
