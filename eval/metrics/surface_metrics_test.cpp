#include "eval/metrics/surface_metrics.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "eval/testing/test_meshes.h"
#include "scenes/random.h"

namespace dressform::metrics {
namespace {

using namespace test_meshes;

Mesh noisy(Mesh mesh, double sigma_m) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const auto n = normal4(11, 2, i);
    mesh.vertices[i] += sigma_m * Vector3d(n[0], n[1], n[2]);
  }
  return mesh;
}

Mesh split(const Mesh& mesh) {  // every triangle in four
  Mesh result{mesh.vertices, {}};
  for (const auto& t : mesh.triangles) {
    const int first = static_cast<int>(result.vertices.size());
    for (int k = 0; k < 3; ++k) result.vertices.push_back((mesh.vertices[t[k]] + mesh.vertices[t[(k + 1) % 3]]) / 2);
    result.triangles.push_back({t[0], first, first + 2});
    result.triangles.push_back({t[1], first + 1, first});
    result.triangles.push_back({t[2], first + 2, first + 1});
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

// Coarser than in use, for speed.
SurfaceComparison compare(const Mesh& estimate, const Mesh& truth, const std::vector<std::uint8_t>& views = {}) {
  SurfaceComparisonOptions options;
  options.spacing_m = 0.003;
  return compare_surfaces(estimate, truth, views, options);
}

const Mesh kBall = sphere(0.3, {0, 1, 0}, 40);

TEST(CompareSurfaces, TruthIsPerfect) {
  const auto same = compare(kBall, kBall);
  EXPECT_LT(same.chamfer_l1_mm, 1e-9);
  EXPECT_LT(same.hausdorff_mm, 1e-9);
  EXPECT_EQ(same.f.at(2), 1);
  EXPECT_NEAR(same.normal_consistency, 1, 1e-9);
  EXPECT_NEAR(same.normal_consistency_signed, 1, 1e-9);
  EXPECT_EQ(same.unobserved_part, 0);
}

TEST(CompareSurfaces, ParallelPlanes) {
  const auto apart = compare(square(0.3, 0.004, 7), square(0.3, 0, 10));
  EXPECT_NEAR(apart.accuracy_mm, 4, 1e-9);
  EXPECT_NEAR(apart.accuracy_median_mm, 4, 1e-9);
  EXPECT_NEAR(apart.completeness_mm, 4, 1e-9);
  EXPECT_NEAR(apart.chamfer_l1_mm, 4, 1e-9);
  EXPECT_NEAR(apart.hausdorff_mm, 4, 1e-9);
  EXPECT_EQ(apart.f.at(2), 0);
  EXPECT_EQ(apart.f.at(5), 1);
}

TEST(CompareSurfaces, HalfOfThePlane) {
  const Mesh truth = square(0.2, 0, 20);
  Mesh half{truth.vertices, {}};
  for (const auto& t : truth.triangles)
    if (truth.vertices[t[0]].x() + truth.vertices[t[1]].x() + truth.vertices[t[2]].x() < 0.3)
      half.triangles.push_back(t);
  const auto result = compare(half, truth);
  EXPECT_EQ(result.precision.at(5), 1);
  EXPECT_NEAR(result.recall.at(5), 0.525, 0.002) << "the half, and 5 mm beside it";
  EXPECT_NEAR(result.f.at(5), 2 * 0.525 / 1.525, 0.002);
  EXPECT_NEAR(result.hausdorff_mm, 100, 0.1);
  EXPECT_NEAR(result.completeness_mm, 25, 0.1);
}

TEST(CompareSurfaces, UnobservedTruthIsAClassOfItsOwn) {
  const Mesh truth = square(0.2, 0, 20);
  std::vector<std::uint8_t> views;
  for (const auto& vertex : truth.vertices) views.push_back(vertex.x() < 0.1 + 1e-9 ? 2 : 0);
  Mesh half{truth.vertices, {}};
  for (const auto& t : truth.triangles)
    if (truth.vertices[t[0]].x() + truth.vertices[t[1]].x() + truth.vertices[t[2]].x() < 0.3)
      half.triangles.push_back(t);
  const auto seen = compare(half, truth, views);
  EXPECT_GT(seen.recall.at(10), 0.999) << "what nobody saw is not asked for";
  EXPECT_NEAR(seen.unobserved_part, 0.475, 0.01);
  // An estimate that invents the unseen half 30 mm off is not blamed; one that does so over the seen half is.
  const auto invented = compare(joined(half, moved(square(0.2, 0.03, 4), {0.11, 0, 0})), truth, views);
  EXPECT_GT(invented.precision.at(10), 0.93);
  const auto wrong = compare(joined(half, moved(square(0.1, 0.03, 4), {0, 0, 0})), truth, views);
  EXPECT_LT(wrong.precision.at(10), 0.7);
}

TEST(CompareSurfaces, RigidInvariance) {
  const Mesh rough = noisy(kBall, 0.002);
  const Eigen::Isometry3d motion =
      Eigen::Translation3d(1, -2, 0.5) * Eigen::AngleAxisd(1.1, Vector3d(1, 2, -1).normalized());
  const auto here = compare(rough, kBall);
  const auto there = compare(transformed(rough, motion.matrix()), transformed(kBall, motion.matrix()));
  EXPECT_NEAR(here.chamfer_l1_mm, there.chamfer_l1_mm, 1e-6);
  EXPECT_NEAR(here.hd95_mm, there.hd95_mm, 1e-6);
  EXPECT_NEAR(here.f.at(2), there.f.at(2), 1e-6);
}

TEST(CompareSurfaces, SwapSymmetry) {
  const Mesh rough = noisy(kBall, 0.002);
  const auto a = compare(rough, kBall), b = compare(kBall, rough);
  EXPECT_NEAR(a.accuracy_mm, b.completeness_mm, 0.01);
  EXPECT_NEAR(a.precision.at(2), b.recall.at(2), 0.003);
  EXPECT_NEAR(a.chamfer_l1_mm, b.chamfer_l1_mm, 0.01);
  EXPECT_NEAR(a.hausdorff_mm, b.hausdorff_mm, 0.5);
}

TEST(CompareSurfaces, WorseWithMoreNoise) {
  double chamfer = 0, f = 1.1, normals = 1.1;
  for (const double sigma : {0.0005, 0.001, 0.002, 0.004}) {
    const auto result = compare(noisy(kBall, sigma), kBall);
    EXPECT_GT(result.chamfer_l1_mm, chamfer);
    EXPECT_LE(result.f.at(2), f);
    EXPECT_LT(result.normal_consistency, normals);
    chamfer = result.chamfer_l1_mm;
    f = result.f.at(2);
    normals = result.normal_consistency;
  }
}

TEST(CompareSurfaces, StableUnderRetessellation) {
  const Mesh rough = noisy(kBall, 0.002);
  const auto coarse = compare(rough, kBall), fine = compare(split(rough), split(kBall));
  EXPECT_NEAR(coarse.chamfer_l1_mm, fine.chamfer_l1_mm, 0.01);
  EXPECT_NEAR(coarse.f.at(2), fine.f.at(2), 0.003);
  EXPECT_NEAR(coarse.accuracy_median_mm, fine.accuracy_median_mm, 0.01);
}

TEST(CompareSurfaces, TurnedNormals) {
  Mesh turned = kBall;
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  const auto result = compare(turned, kBall);
  EXPECT_NEAR(result.normal_consistency, 1, 1e-9);
  EXPECT_NEAR(result.normal_consistency_signed, -1, 1e-9);
}

TEST(CompareSurfaces, RefusesMeshesWithoutArea) {
  EXPECT_THROW(compare_surfaces(Mesh{}, kBall), std::invalid_argument);
  EXPECT_THROW(compare_surfaces(kBall, Mesh{}), std::invalid_argument);
  EXPECT_THROW(compare_surfaces(kBall, kBall, {1, 2, 3}), std::invalid_argument);
}

TEST(FScore, KnownValues) {
  EXPECT_EQ(f_score(0, 0), 0);
  EXPECT_EQ(f_score(1, 1), 1);
  EXPECT_NEAR(f_score(0.5, 1), 2.0 / 3, 1e-15);
}

}  // namespace
}  // namespace dressform::metrics
