#include "eval/score/mesh_bounds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/testing/test_meshes.h"
#include "scenes/error.h"

namespace dressform {
namespace {

using namespace test_meshes;
using testing::HasSubstr;

Mesh shirt() { return tube(0.22, 0.16, {0, 0, 0}, 0.9, 1.5, 32, 20, false); }

Mesh scaled(Mesh mesh, double factor) {
  for (auto& vertex : mesh.vertices) vertex *= factor;
  return mesh;
}

std::string refusal(const Mesh& mesh, double usual_side_m = kGarmentSide_m) {
  try {
    check_mesh_bounds(mesh, "out/top.ply", usual_side_m);
  } catch (const InputError& error) {
    return error.what();
  }
  return "taken";
}

TEST(MeshBounds, PeopleAndClothesAreTaken) {
  EXPECT_EQ(refusal(shirt()), "taken");
  EXPECT_EQ(refusal(figure()), "taken");
  EXPECT_EQ(refusal(scaled(figure(), 0.55)), "taken") << "a child";
}

TEST(MeshBounds, OtherUnitsAreRefusedByName) {
  EXPECT_THAT(refusal(scaled(shirt(), 1000)), HasSubstr("out/top.ply: found a mesh of 440 x 600 x 320"));
  EXPECT_THAT(refusal(scaled(shirt(), 1000)), HasSubstr("looks like millimetres"));
  EXPECT_THAT(refusal(scaled(figure(), 100), kPersonSide_m), HasSubstr("looks like centimetres"));
  EXPECT_THAT(refusal(scaled(figure(), 10), kPersonSide_m), HasSubstr("looks like decimetres"));
  EXPECT_THAT(refusal(scaled(figure(), 39.37), kPersonSide_m), HasSubstr("looks like inches"));
  EXPECT_THAT(refusal(scaled(shirt(), 1e6)), HasSubstr("expected metres"));
  EXPECT_THAT(refusal(scaled(shirt(), 1e6)), Not(HasSubstr("looks like")));
  EXPECT_THAT(refusal(scaled(shirt(), 0.001)), HasSubstr("expected metres"));
}

TEST(MeshBounds, CrumpledMeshesAreRefusedByTheirArea) {
  Mesh mesh = square(1, 0, 1);
  for (int i = 0; i < 20; ++i) mesh = i == 0 ? mesh : joined(mesh, square(1, 0.001 * i, 1));
  EXPECT_THAT(refusal(mesh), HasSubstr("20 square metres"));
}

TEST(MeshBounds, TwoFilesOfOneSurface) {
  const Mesh coarse = shirt(), moved_little = moved(shirt(), {0.001, 0, 0});
  EXPECT_NO_THROW(check_same_surface(coarse, "top.ply", moved_little, "top.glb"));
  const auto contradiction = [&](const Mesh& second) -> std::string {
    try {
      check_same_surface(coarse, "top.ply", second, "top.glb");
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(contradiction(moved(shirt(), {0, 0.01, 0})), HasSubstr("top.ply: contradicts top.glb"));
  EXPECT_THAT(contradiction(moved(shirt(), {0, 0.01, 0})), HasSubstr("10.0 mm apart"));
  const Mesh half = tube(0.22, 0.16, {0, 0, 0}, 0.9, 1.2, 32, 10, false);
  EXPECT_THAT(contradiction(half), HasSubstr("300.0 mm apart")) << "what one of them lacks";
}

}  // namespace
}  // namespace dressform
