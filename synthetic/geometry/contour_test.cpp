#include "synthetic/geometry/contour.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/mesh.h"
#include "scenes/random.h"

namespace dressform {
namespace {

const Eigen::AlignedBox3d kBox(Vector3d(-0.12, -0.12, -0.12), Vector3d(0.12, 0.12, 0.12));

TEST(Contour, SphereIsOnItsRadius) {
  const Mesh mesh = contour([](const Vector3d& p) { return p.norm() - 0.1; }, kBox, 0.008);
  EXPECT_TRUE(topology(mesh).closed());
  EXPECT_EQ(topology(mesh).euler(), 2);
  for (const Vector3d& v : mesh.vertices) EXPECT_NEAR(v.norm(), 0.1, 2e-5);
}

// Sheets, tunnels and bridges as thin as the grid's cells, everywhere.
TEST(Contour, ClosedWhereverSheetsPinch) {
  for (int seed = 0; seed < 20; ++seed) {
    std::vector<Vector3d> waves;
    std::vector<double> phases;
    for (int i = 0; i < 8; ++i) {
      const auto u = uniform4(seed, 1, i);
      const double z = 2 * u[0] - 1, turn = 2 * M_PI * u[1], across = std::sqrt(1 - z * z);
      waves.push_back(2 * M_PI / (0.03 + 0.02 * u[2]) * Vector3d(across * std::cos(turn), across * std::sin(turn), z));
      phases.push_back(2 * M_PI * u[3]);
    }
    const auto sponge = [&](const Vector3d& p) {
      double sum = 0;
      for (std::size_t i = 0; i < waves.size(); ++i) sum += std::cos(waves[i].dot(p) + phases[i]);
      return std::max(p.norm() - 0.1, 0.002 * sum);
    };
    const Mesh mesh = contour(sponge, kBox, 0.008);
    EXPECT_TRUE(topology(mesh).closed()) << seed;
    EXPECT_GT(mesh.triangles.size(), 1000u);
  }
}

TEST(Contour, SaysWhereNothingCloses) {
  const auto half_space = [](const Vector3d& p) { return p.y() - 0.01; };  // goes on beyond the box
  EXPECT_FALSE(closed_contour(half_space, kBox, 0.008));
  EXPECT_THROW(contour(half_space, kBox, 0.008), std::runtime_error);
}

TEST(Contour, NothingInsideIsAnError) {
  EXPECT_THROW(contour([](const Vector3d&) { return 1.0; }, kBox, 0.008), std::runtime_error);
}

}  // namespace
}  // namespace dressform
