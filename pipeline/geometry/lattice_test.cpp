#include "pipeline/geometry/lattice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/random.h"

namespace dressform {
namespace {

template <class F>
std::vector<float> sampled(const Lattice& lattice, F&& f) {
  std::vector<float> field(lattice.count());
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = static_cast<float>(f(lattice.point(i)));
  return field;
}

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const Vector3i& t : mesh.triangles)
    sum += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6;
  return sum;
}

double torus(const Vector3d& p) {
  const double ring = std::hypot(p.x(), p.z()) - 0.1;
  return std::hypot(ring, p.y()) - 0.03;
}

TEST(Lattice, SphereIsClosedOutwardAndRound) {
  const Lattice lattice = make_lattice({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}, 0.02, 0.006);
  const Mesh mesh = lattice_surface(lattice, sampled(lattice, [](const Vector3d& p) { return p.norm() - 0.1; }));
  const Topology t = topology(mesh);
  EXPECT_TRUE(t.closed());
  EXPECT_EQ(t.components, 1);
  EXPECT_EQ(t.euler(), 2);
  for (const Vector3d& v : mesh.vertices) EXPECT_NEAR(v.norm(), 0.1, 3e-4);
  EXPECT_NEAR(volume(mesh), 4.0 / 3 * M_PI * 1e-3, 2e-5);
}

TEST(Lattice, TorusKeepsItsHandleUntilItIsMadeABall) {
  const Lattice lattice = make_lattice({-0.13, -0.03, -0.13}, {0.13, 0.03, 0.13}, 0.02, 0.006);
  const auto field = sampled(lattice, torus);
  EXPECT_EQ(topology(lattice_surface(lattice, field)).euler(), 0);
  BallReport report;
  const Mesh ball = lattice_surface(lattice, ball_field(lattice, field, report));
  EXPECT_TRUE(topology(ball).closed());
  EXPECT_EQ(topology(ball).euler(), 2);
  EXPECT_GT(report.cut_points, 10);
  EXPECT_LT(report.cut_points, 300);  // a disc across the ring
}

TEST(Lattice, HollowsAreFilledAndCrumbsDropped) {
  const Lattice lattice = make_lattice({-0.1, -0.1, -0.1}, {0.2, 0.1, 0.1}, 0.02, 0.006);
  BallReport report;
  const Mesh ball =
      lattice_surface(lattice, ball_field(lattice,
                                          sampled(lattice,
                                                  [](const Vector3d& p) {
                                                    const double shell = std::max(p.norm() - 0.1, 0.05 - p.norm());
                                                    return std::min(shell, (p - Vector3d(0.17, 0, 0)).norm() - 0.02);
                                                  }),
                                          report));
  EXPECT_EQ(topology(ball).components, 1);
  EXPECT_EQ(topology(ball).euler(), 2);
  EXPECT_GT(report.filled_points, 1000);
  EXPECT_GT(report.cut_points, 50);
}

TEST(Lattice, AnyNoiseBecomesABall) {
  const Lattice lattice = make_lattice({0, 0, 0}, {0.1, 0.1, 0.1}, 0, 0.006);
  for (int seed = 0; seed < 20; ++seed) {
    std::vector<float> field(lattice.count());
    for (std::size_t i = 0; i < field.size(); ++i) field[i] = static_cast<float>(uniform(seed, 0, i) - 0.5);
    BallReport report;
    const Mesh ball = lattice_surface(lattice, ball_field(lattice, field, report));
    const Topology t = topology(ball);
    EXPECT_TRUE(t.closed());
    EXPECT_EQ(t.components, 1);
    EXPECT_EQ(t.euler(), 2);
    EXPECT_GT(volume(ball), 0);
  }
}

TEST(Lattice, NothingInsideGivesNothing) {
  const Lattice lattice = make_lattice({0, 0, 0}, {0.1, 0.1, 0.1}, 0, 0.01);
  BallReport report;
  EXPECT_TRUE(ball_field(lattice, std::vector<float>(lattice.count(), 1.0f), report).empty());
}

}  // namespace
}  // namespace dressform
