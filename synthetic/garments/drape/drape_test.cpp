#include "synthetic/garments/drape/drape.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "synthetic/garments/drape/even_mesh.h"
#include "synthetic/geometry/self_intersection.h"

namespace dressform {
namespace {

// A flat sheet in x and z at height y, width by depth, in right-angled triangles.
Mesh sheet(double width, double depth, double y, int columns, int rows) {
  Mesh mesh;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i)
      mesh.vertices.emplace_back(width * (double(i) / columns - 0.5), y, depth * (double(j) / rows - 0.5));
  const auto at = [&](int i, int j) { return j * (columns + 1) + i; };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      mesh.triangles.emplace_back(at(i, j), at(i, j + 1), at(i + 1, j));
      mesh.triangles.emplace_back(at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
    }
  return mesh;
}

Mesh sphere(double radius, int rings, int columns) {
  Mesh mesh;
  mesh.vertices.emplace_back(0, radius, 0);
  for (int j = 1; j < rings; ++j)
    for (int i = 0; i < columns; ++i) {
      const double a = M_PI * j / rings, b = 2 * M_PI * i / columns;
      mesh.vertices.emplace_back(radius * std::sin(a) * std::cos(b), radius * std::cos(a),
                                 radius * std::sin(a) * std::sin(b));
    }
  mesh.vertices.emplace_back(0, -radius, 0);
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  const auto at = [&](int j, int i) { return 1 + (j - 1) * columns + i % columns; };
  for (int i = 0; i < columns; ++i) {
    mesh.triangles.emplace_back(0, at(1, i + 1), at(1, i));
    for (int j = 1; j + 1 < rings; ++j) {
      mesh.triangles.emplace_back(at(j, i), at(j, i + 1), at(j + 1, i));
      mesh.triangles.emplace_back(at(j, i + 1), at(j + 1, i + 1), at(j + 1, i));
    }
    mesh.triangles.emplace_back(at(rings - 1, i), at(rings - 1, i + 1), last);
  }
  return mesh;
}

Fullness same_size() {
  return [](const Vector3d&) { return Eigen::Matrix3d::Identity(); };
}

Wearer nobody(const Cloth& cloth) {
  Wearer wearer;
  wearer.clearance_m.assign(cloth.mesh.vertices.size(), 0.004);
  return wearer;
}

std::function<bool(const Vector3d&)> free_everywhere() {
  return [](const Vector3d&) { return false; };
}

// A strip held at one end hangs straight down, longer by what its own weight stretches it.
TEST(Drape, StripHangsAsLongAsItsWeightStretchesIt) {
  const double length = 0.3;
  const Mesh flat = sheet(0.06, length, 1, 6, 30);
  const Cloth cloth = cloth_as_cut(flat, same_size(), [&](const Vector3d& p) { return p.z() < -0.5 * length + 1e-6; });
  DrapeParams params;
  params.seconds = 3;
  params.step_s = 1.0 / 4000;
  const DrapeResult result = drape(cloth, nobody(cloth), params, 1);
  double lowest = 1;
  for (const Vector3d& v : result.vertices) lowest = std::min(lowest, v.y());
  // Strain falls from length * stretch_per_m at the top to nothing: on average half of it.
  const double expected = length * (1 + 0.5 * length * params.stretch_per_m);
  EXPECT_NEAR(1 - lowest, expected, 0.01 * length);
  EXPECT_TRUE(result.converged) << result.speed_m_per_s;
  EXPECT_LT(result.strain_p95, 0.02);
  for (size_t i = 0; i < flat.vertices.size(); ++i)
    if (cloth.held[i]) {
      EXPECT_EQ(result.vertices[i], flat.vertices[i]);
    }
}

// Peirce's cantilever test: a strip that stands out by two bending lengths hangs at 41.5 degrees; a stiffer one hangs
// less.
TEST(Drape, CantileverBendsByItsBendingLength) {
  constexpr double kEdge = 0.01;
  const double overhang = 0.08 + 0.5 * kEdge;  // the hinge at the clamp bends for half an edge more
  const auto droop_deg = [&](double bending_length) {
    const Mesh flat = sheet(0.04, 0.12, 1, 4, 12);
    const Cloth cloth = cloth_as_cut(flat, same_size(), [](const Vector3d& p) { return p.z() < -0.02 + 1e-6; });
    DrapeParams params;
    params.bending_length_m = bending_length;
    params.ruffle_m = 0;
    params.seconds = 2;
    params.step_s = 1.0 / 8000;
    const DrapeResult result = drape(cloth, nobody(cloth), params, 1);
    const Vector3d tip = result.vertices.back();
    return std::atan2(1 - tip.y(), tip.z() - (0.06 - overhang)) * 180 / M_PI;
  };
  EXPECT_NEAR(droop_deg(0.5 * overhang), 41.5, 6);
  EXPECT_LT(droop_deg(overhang), 12);
  EXPECT_GT(droop_deg(0.25 * overhang), 60);
}

class OnASphere : public testing::Test {
 protected:
  const Mesh ball_ = sphere(0.12, 40, 80);
  const SurfaceDistance skin_{ball_};
  const Cloth cloth_ = cloth_as_cut(even_mesh(sheet(0.5, 0.5, 0.13, 40, 40), std::vector<int>(3200, 0), 0.015),
                                    same_size(), free_everywhere());

  DrapeResult dropped() const {
    Wearer wearer = nobody(cloth_);
    wearer.body = &skin_;
    return drape(cloth_, wearer, {}, 1);
  }
};

TEST_F(OnASphere, ClothLiesOnItInFoldsAndMeetsNothing) {
  const DrapeResult result = dropped();
  Mesh lying = cloth_.mesh;
  lying.vertices = result.vertices;
  double lowest = 1;
  for (const Vector3d& v : lying.vertices) {
    EXPECT_GE(v.norm(), 0.12 + 0.0035);
    lowest = std::min(lowest, v.y());
  }
  for (const Vector3i& t : lying.triangles)
    EXPECT_GT((lying.vertices[t[0]] + lying.vertices[t[1]] + lying.vertices[t[2]]).norm() / 3, 0.12);
  EXPECT_LT(lowest, -0.05);  // it hangs over the sides
  EXPECT_EQ(self_intersections(lying), 0);
  EXPECT_LT(result.strain_p95, 0.05);
  EXPECT_EQ(topology(lying).loops, 1);
}

TEST_F(OnASphere, OneThreadAndTwoGiveTheSameBytes) {
  const tbb::global_control* one = new tbb::global_control(tbb::global_control::max_allowed_parallelism, 1);
  const DrapeResult alone = dropped();
  delete one;
  EXPECT_EQ(alone.vertices, dropped().vertices);
}

// Cloth let fall on a shelf of other cloth stays above it.
TEST(Drape, ClothRestsOnAnotherLayer) {
  const Cloth cloth = cloth_as_cut(sheet(0.2, 0.2, 0.02, 16, 16), same_size(), free_everywhere());
  Wearer wearer = nobody(cloth);
  wearer.layer = sheet(0.4, 0.4, 0, 30, 30);
  const DrapeResult result = drape(cloth, wearer, {}, 1);
  Mesh lying = cloth.mesh;
  lying.vertices = result.vertices;
  for (const Vector3d& v : lying.vertices) {
    EXPECT_GT(v.y(), 0.001);
    EXPECT_LT(v.y(), 0.010);
  }
  EXPECT_TRUE(crossing_triangles(lying, wearer.layer).empty());
}

// A tube of cloth much wider at its free end than at the ring that holds it cannot hang smooth: it waves.
TEST(Drape, FullClothFallsInFolds) {
  Mesh tube;
  const int columns = 60, rows = 20;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const double a = 2 * M_PI * i / columns;
      tube.vertices.emplace_back(0.1 * std::sin(a), 1 - 0.01 * j, 0.1 * std::cos(a));
    }
  const auto at = [&](int i, int j) { return j * columns + i % columns; };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      tube.triangles.emplace_back(at(i, j), at(i, j + 1), at(i + 1, j));
      tube.triangles.emplace_back(at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
    }
  const Cloth cloth = cloth_as_cut(
      tube,
      [](const Vector3d& p) {
        Eigen::Matrix3d wider = (1 + 7 * (1 - p.y())) * Eigen::Matrix3d::Identity();
        wider(1, 1) = 1;
        return wider;
      },
      [](const Vector3d& p) { return p.y() > 0.999; });
  const DrapeResult result = drape(cloth, nobody(cloth), {}, 3);
  double least = 1, most = 0;
  for (int i = 0; i < columns; ++i) {
    const Vector3d& v = result.vertices[at(i, rows)];
    least = std::min(least, std::hypot(v.x(), v.z()));
    most = std::max(most, std::hypot(v.x(), v.z()));
  }
  EXPECT_GT(most - least, 0.015);
  EXPECT_LT(result.strain_p95, 0.05);
  Mesh lying = cloth.mesh;
  lying.vertices = result.vertices;
  EXPECT_EQ(self_intersections(lying), 0);
}

TEST(NearPairs, FindsVertexAboveTriangleAndCrossingEdges) {
  const std::vector<Vector3d> x = {{0, 0, 0},       {1, 0, 0}, {0, 0, 1},   // a triangle
                                   {0.2, 0.1, 0.2}, {5, 5, 5}, {5, 6, 5}};  // one with a corner above it
  const NearResult near = near_pairs(x, features_of({{0, 2, 1}, {3, 4, 5}}), 6, 0.15);
  ASSERT_EQ(near.pairs.size(), 1u);
  EXPECT_EQ(near.pairs[0].vertex[0], 3);
  EXPECT_NEAR(near.pairs[0].gap_m, 0.1, 1e-12);
  EXPECT_NEAR((near.pairs[0].normal - Vector3d(0, 1, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR(near.room_m[3], 0.1, 1e-12);
  EXPECT_NEAR(near.room_m[0], 0.1, 1e-12);
  EXPECT_NEAR(near.room_m[4], 0.15, 1e-12);

  const std::vector<Vector3d> crossing = {{-1, 0, 0}, {1, 0, 0}, {0, -5, 0}, {0, 0.1, -1}, {0, 0.1, 1}, {0, 5, 0}};
  const NearResult edges = near_pairs(crossing, features_of({{0, 1, 2}, {3, 4, 5}}), 6, 0.15);
  ASSERT_EQ(edges.pairs.size(), 1u);
  EXPECT_NEAR(edges.pairs[0].gap_m, 0.1, 1e-12);
  EXPECT_TRUE(near_pairs(crossing, features_of({{0, 1, 2}, {3, 4, 5}}), 0, 0.15).pairs.empty());  // nothing moves
}

TEST(EvenMesh, KeepsRimSeamAndAreaAndEvensTheEdges) {
  Mesh mesh = sheet(0.4, 0.2, 0, 20, 3);
  std::vector<int> piece;
  for (const Vector3i& t : mesh.triangles)
    piece.push_back((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]).x() > 0);
  const Mesh even = even_mesh(mesh, piece, 0.02);
  double area = 0;
  for (const Vector3i& t : even.triangles) {
    const Vector3d &a = even.vertices[t[0]], &b = even.vertices[t[1]], &c = even.vertices[t[2]];
    area += 0.5 * (b - a).cross(c - a).norm();
    const double low = std::min({a.x(), b.x(), c.x()}), high = std::max({a.x(), b.x(), c.x()});
    EXPECT_TRUE(high < 1e-9 || low > -1e-9);  // none across the seam
    for (const double edge : {(a - b).norm(), (b - c).norm(), (c - a).norm()}) {
      EXPECT_GT(edge, 0.008);
      EXPECT_LT(edge, 0.04);
    }
  }
  EXPECT_NEAR(area, 0.08, 1e-6);
  EXPECT_EQ(topology(even).loops, 1);
}

TEST(Cloth, HalvedHasTheSameShapeAndHalfTheRestLengths) {
  const Mesh flat = sheet(0.1, 0.1, 0, 4, 4);
  const Fullness wider = [](const Vector3d&) { return 1.5 * Eigen::Matrix3d::Identity(); };
  const Cloth cloth = cloth_as_cut(flat, wider, [](const Vector3d& p) { return p.x() < -0.049; });
  const Cloth fine = halved(cloth, flat, wider);
  EXPECT_EQ(fine.mesh.triangles.size(), 4 * flat.triangles.size());
  EXPECT_EQ(topology(fine.mesh).euler(), topology(flat).euler());
  EXPECT_EQ(std::count(fine.held.begin(), fine.held.end(), 1), 9);
  EXPECT_NEAR(strain_quantile(fine, fine.mesh.vertices, 0.95), 1 - 1 / 1.5, 1e-9);
}

}  // namespace
}  // namespace dressform
