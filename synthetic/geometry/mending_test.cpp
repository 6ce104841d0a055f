#include "synthetic/geometry/mending.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scenes/error.h"

namespace dressform {
namespace {

// An open tube about y, radius 0.3, from 0.9 to 1.5, outward.
Mesh tube(int around = 24, int rows = 8) {
  Mesh mesh;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * M_PI * i / around;
      mesh.vertices.emplace_back(0.3 * std::sin(angle), 0.9 + 0.6 * j / rows, 0.3 * std::cos(angle));
    }
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = j * around + i, b = j * around + (i + 1) % around;
      mesh.triangles.emplace_back(a, b, b + around);
      mesh.triangles.emplace_back(a, b + around, a + around);
    }
  return mesh;
}

// Adds a patch 2 cm before the tube's quads (columns 2 to 5, rows 2 to 4), sewn to it at three sides, open at the top.
void add_pocket(Mesh& mesh, int around = 24) {
  std::vector<std::vector<int>> grid;
  for (int j = 2; j <= 4; ++j) {
    grid.emplace_back();
    for (int i = 2; i <= 5; ++i) {
      const bool sewn = j == 2 || i == 2 || i == 5;
      const Vector3d on = mesh.vertices[j * around + i];
      grid.back().push_back(sewn ? j * around + i : static_cast<int>(mesh.vertices.size()));
      if (!sewn) mesh.vertices.push_back(on + 0.02 * Vector3d(on.x(), 0, on.z()).normalized());
    }
  }
  for (std::size_t j = 0; j + 1 < grid.size(); ++j)
    for (std::size_t i = 0; i + 1 < grid[j].size(); ++i) {
      mesh.triangles.emplace_back(grid[j][i], grid[j][i + 1], grid[j + 1][i + 1]);
      mesh.triangles.emplace_back(grid[j][i], grid[j + 1][i + 1], grid[j + 1][i]);
    }
}

// Every triangle with vertices of its own, off by up to `off_m`.
Mesh unwelded(const Mesh& mesh, double off_m) {
  Mesh result;
  for (const Vector3i& t : mesh.triangles) {
    const int first = static_cast<int>(result.vertices.size());
    for (int k = 0; k < 3; ++k)
      result.vertices.push_back(mesh.vertices[t[k]] + Vector3d::Constant(off_m * std::sin(double(first + 7 * k))));
    result.triangles.emplace_back(first, first + 1, first + 2);
  }
  return result;
}

MendedMesh mend(const Mesh& mesh) { return mended({mesh, {}, {}}, "a.obj"); }

TEST(Mending, LeavesASoundMeshAsItIs) {
  const MendedMesh result = mend(tube());
  EXPECT_EQ(result.textured.mesh.vertices, tube().vertices);
  EXPECT_EQ(result.textured.mesh.triangles, tube().triangles);
  EXPECT_EQ(result.area_m2.size(), 1u);
}

TEST(Mending, JoinsWhatWasExportedApart) {
  for (double off_m : {0.0, 2e-5}) {
    const MendedMesh result = mend(unwelded(tube(), off_m));
    const Topology shape = topology(result.textured.mesh);
    EXPECT_EQ(shape.vertices, static_cast<int>(tube().vertices.size()));
    EXPECT_EQ(shape.loops, 2);
    EXPECT_EQ(shape.components, 1);
  }
  EXPECT_GT(mend(unwelded(tube(), 1e-3)).area_m2.size(), 1u) << "a millimetre is a gap";
}

TEST(Mending, PartsAPocketFromItsGarment) {
  Mesh mesh = tube();
  add_pocket(mesh);
  ASSERT_EQ(topology(mesh).non_manifold_edges, 8) << "seven along the seam, and a diagonal that both have";
  const MendedMesh result = mend(mesh);
  EXPECT_EQ(topology(result.textured.mesh).non_manifold_edges, 0);
  ASSERT_EQ(result.area_m2.size(), 2u);
  const Mesh garment = piece_of(result, 0), pocket = piece_of(result, 1);
  EXPECT_EQ(garment.triangles.size(), tube().triangles.size());
  EXPECT_EQ(topology(garment).loops, 2);
  EXPECT_EQ(pocket.triangles.size(), 11u) << "of twelve, one corner has all its vertices in the shirt: a double";
  EXPECT_EQ(result.textured.mesh.triangles.size(), mesh.triangles.size() - 1) << "the pocket is still there";
}

TEST(Mending, TurnsFlippedPanels) {
  TexturedMesh textured{tube(), {}, {}};
  for (std::size_t t = 0; t < textured.mesh.triangles.size(); ++t) {
    textured.corner_uv.push_back({Vector2f(0, 0), Vector2f(0.25f, 0), Vector2f(0, 0.5f)});
    if (t % 3 == 0) continue;
    std::swap(textured.mesh.triangles[t][1], textured.mesh.triangles[t][2]);
    std::swap(textured.corner_uv[t][1], textured.corner_uv[t][2]);
  }
  const MendedMesh result = mended(textured, "a.obj");
  EXPECT_EQ(result.textured.mesh.triangles.size(), tube().triangles.size());
  const auto normals = vertex_normals(result.textured.mesh);
  for (std::size_t v = 0; v < normals.size(); ++v)
    EXPECT_GT(normals[v].dot(result.textured.mesh.vertices[v] - Vector3d(0, result.textured.mesh.vertices[v].y(), 0)),
              0);
  for (std::size_t t = 0; t < result.textured.corner_uv.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Vector2f& uv = result.textured.corner_uv[t][k];
      const int v = result.textured.mesh.triangles[t][k];
      EXPECT_EQ(uv.x() > 0, v == tube().triangles[t][1]) << "coordinates go with their corners";
    }
}

TEST(Mending, DropsDoublesAndTrianglesWithoutCorners) {
  Mesh mesh = tube();
  mesh.triangles.push_back(mesh.triangles[5]);
  mesh.triangles.emplace_back(mesh.triangles[6][1], mesh.triangles[6][0], mesh.triangles[6][2]);
  mesh.triangles.emplace_back(3, 3, 4);
  EXPECT_EQ(mend(mesh).textured.mesh.triangles, tube().triangles);
}

TEST(Mending, NamesAOneSidedSurface) {
  Mesh band;
  constexpr int kSteps = 12;
  for (int i = 0; i < kSteps; ++i)
    for (double side : {-0.1, 0.1}) {
      const double angle = 2 * M_PI * i / kSteps, twist = angle / 2;
      const double r = 0.5 + side * std::cos(twist);
      band.vertices.emplace_back(r * std::cos(angle), 1 + side * std::sin(twist), r * std::sin(angle));
    }
  for (int i = 0; i < kSteps; ++i) {
    const int a = 2 * i, b = a + 1;
    const int c = i + 1 < kSteps ? a + 2 : 1, d = i + 1 < kSteps ? a + 3 : 0;  // joined upside down
    band.triangles.emplace_back(a, c, b);
    band.triangles.emplace_back(b, c, d);
  }
  try {
    mend(band);
    FAIL() << "a Moebius band";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("a.obj: found a one-sided surface"));
  }
}

}  // namespace
}  // namespace dressform
