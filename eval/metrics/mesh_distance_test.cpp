#include "eval/metrics/mesh_distance.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "eval/metrics/sampling.h"
#include "eval/testing/test_meshes.h"
#include "scenes/random.h"

namespace dressform::metrics {
namespace {

using namespace test_meshes;

std::vector<Vector3d> random_points(int count, double size) {
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const auto u = uniform4(3, 1, i);
    points.push_back(Vector3d(u[0] - 0.5, u[1] - 0.5, u[2] - 0.5) * size);
  }
  return points;
}

// Least distance over very many points of the triangle: an independent, slow answer.
double by_search(const Mesh& mesh, const Vector3d& p) {
  double best = 1e9;
  for (const auto& t : mesh.triangles) {
    const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    for (int i = 0; i <= 60; ++i)
      for (int j = 0; i + j <= 60; ++j) best = std::min(best, (a + (b - a) * i / 60.0 + (c - a) * j / 60.0 - p).norm());
  }
  return best;
}

TEST(MeshDistance, PlaneEdgeAndCorner) {
  const Mesh mesh = square(1, 0, 1);
  const MeshDistance distance(mesh);
  EXPECT_DOUBLE_EQ(distance.nearest(Vector3d(0.3, 0.2, -0.7)).distance_m, 0.7);
  EXPECT_DOUBLE_EQ(distance.nearest(Vector3d(-0.3, 0.5, 0.4)).distance_m, 0.5);
  EXPECT_DOUBLE_EQ(distance.nearest(Vector3d(-1, -2, 2)).distance_m, 3);
  EXPECT_EQ(distance.nearest(Vector3d(-1, -2, 2)).nearest_vertex, 0);
  EXPECT_EQ(distance.nearest(Vector3d(0.5, 0.5, 1)).triangle, 0) << "of equals the lowest";
}

TEST(MeshDistance, AgreesWithSearchOnRandomTriangles) {
  Mesh mesh;
  mesh.vertices = random_points(30, 1);
  for (int i = 0; i < 30; i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
  const MeshDistance distance(mesh);
  for (const auto& point : random_points(40, 2)) {
    const double found = distance.nearest(point).distance_m, searched = by_search(mesh, point);
    EXPECT_LE(found, searched + 1e-12);
    EXPECT_NEAR(found, searched, 0.02);
  }
}

TEST(MeshDistance, ManyPointsGiveTheSameAnswersInOrderAndOnAnyNumberOfThreads) {
  const Mesh mesh = sphere(0.5, {0, 0, 0}, 24);
  const auto points = random_points(20000, 2);
  const MeshDistance distance(mesh);
  const auto many = distance.nearest(points);
  std::vector<NearestOnMesh> alone;
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    alone = distance.nearest(points);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto single = distance.nearest(points[i]);
    ASSERT_EQ(many[i].distance_m, single.distance_m);
    ASSERT_EQ(many[i].triangle, single.triangle);
    ASSERT_EQ(many[i].distance_m, alone[i].distance_m);
    ASSERT_EQ(many[i].triangle, alone[i].triangle);
    EXPECT_NEAR(many[i].distance_m, std::abs(points[i].norm() - 0.5), 0.005);
  }
}

TEST(MeshDistance, FlatTrianglesAndFarPoints) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 0, 0}};
  const MeshDistance distance(mesh);
  EXPECT_NEAR(distance.nearest(Vector3d(1.5, 3, 0)).distance_m, 3, 1e-12);
  EXPECT_NEAR(distance.nearest(Vector3d(0, 0, 1000)).distance_m, 1000, 1e-9);
  EXPECT_THROW(MeshDistance(Mesh{}), std::invalid_argument);
}

TEST(MeshDistance, LinesOfSight) {
  const MeshDistance wall(square(1, 0, 4));
  EXPECT_FALSE(wall.sees({0.5, 0.5, 1}, {0.5, 0.5, -1}));
  EXPECT_TRUE(wall.sees({0.5, 0.5, 1}, {0.5, 0.5, 0}));
  EXPECT_TRUE(wall.sees({1.5, 0.5, 1}, {1.5, 0.5, -1}));
}

TEST(WindingNumber, InsideAndOutside) {
  const Mesh ball = sphere(1, {0, 0, 0}, 16);
  EXPECT_NEAR(winding_number(ball, {0.2, 0.3, 0.1}), 1, 1e-9);
  EXPECT_NEAR(winding_number(ball, {1.2, 0.3, 0.1}), 0, 1e-9);
}

TEST(Sampling, EvenAndRepeatable) {
  const Mesh mesh = square(1, 0, 3);
  const auto samples = sample_surface(mesh, 0.01, 5);
  ASSERT_EQ(samples.points.size(), 10000u);
  EXPECT_EQ(samples.points, sample_surface(mesh, 0.01, 5).points);
  EXPECT_NE(samples.points, sample_surface(mesh, 0.01, 6).points);
  Vector3d sum = Vector3d::Zero();
  int quarter = 0;
  for (const auto& point : samples.points) {
    sum += point;
    quarter += point.x() < 0.5 && point.y() < 0.5;
    EXPECT_EQ(point.z(), 0);
  }
  EXPECT_NEAR(sum.x() / 1e4, 0.5, 0.01);
  EXPECT_NEAR(quarter, 2500, 60);
  EXPECT_TRUE(sample_surface(Mesh{}, 0.01, 1).points.empty());
}

TEST(Sampling, Quantiles) {
  EXPECT_EQ(quantile({3, 1, 2}, 0.5), 2);
  EXPECT_EQ(quantile({1, 2}, 0.5), 1.5);
  EXPECT_EQ(quantile({5, 1, 4, 2, 3}, 1), 5);
  EXPECT_EQ(quantile({5, 1, 4, 2, 3}, 0), 1);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
  EXPECT_TRUE(std::isnan(mean({})));
}

}  // namespace
}  // namespace dressform::metrics
