#include "pipeline/fit/displacement_lattice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace dressform {
namespace {

using Between = DisplacementLattice::Between;
const DisplacementLattice::Box kBox{{-1, -1, -1}, {1, 1, 1}};

std::vector<Vector3d> spread_in_box(int count) {
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i)
    points.emplace_back(0.9 * std::sin(i * 1.7), 0.9 * std::cos(i * 2.3), 0.9 * std::sin(i * 0.9 + 1));
  return points;
}

TEST(DisplacementLattice, AffineMapsBendNothing) {
  Eigen::Matrix3d a;
  a << 1.1, 0.1, 0, -0.2, 0.9, 0.05, 0, 0.1, 1.3;
  const auto affine = [&](const Vector3d& p) -> Vector3d { return a * p + Vector3d(0.1, 0.2, -0.1); };
  std::vector<Vector3d> targets;
  for (const Vector3d& p : spread_in_box(60)) targets.push_back(affine(p));
  for (const Between between : {Between::cubic, Between::linear}) {
    const DisplacementLattice lattice(kBox, 0.4, between, 1, spread_in_box(60), targets);
    for (const Vector3d& p : {Vector3d(0, 0, 0), Vector3d(0.8, -0.7, 0.6), Vector3d(-1, 1, 1)})
      EXPECT_LT((lattice(p) - affine(p)).norm(), 1e-5);
    EXPECT_LT((lattice({5, 0, 0}) - Vector3d(5, 0, 0) - lattice({1, 0, 0}) + Vector3d(1, 0, 0)).norm(), 1e-9);
  }
}

TEST(DisplacementLattice, SoftOnesReachTheirTargetsStiffOnesDoNot) {
  const auto bent = [](const Vector3d& p) -> Vector3d { return p + Vector3d(0, 0.2 * p.x() * p.x(), 0); };
  std::vector<Vector3d> targets;
  for (const Vector3d& p : spread_in_box(300)) targets.push_back(bent(p));
  for (const Between between : {Between::cubic, Between::linear}) {
    const DisplacementLattice soft(kBox, 0.4, between, 1e-4, spread_in_box(300), targets);
    const DisplacementLattice stiff(kBox, 0.4, between, 1e4, spread_in_box(300), targets);
    EXPECT_LT((soft({0.8, 0, 0}) - bent({0.8, 0, 0})).norm(), 0.02);
    EXPECT_GT((stiff({0.8, 0, 0}) - bent({0.8, 0, 0})).norm(), 0.02);
  }
}

TEST(DisplacementLattice, NothingPullsNothing) {
  const DisplacementLattice lattice(kBox, 0.5, Between::cubic, 1, {}, {});
  EXPECT_EQ(lattice({0.3, 0.2, 0.1}), Vector3d(0.3, 0.2, 0.1));
  EXPECT_THROW(DisplacementLattice(kBox, 0.5, Between::cubic, 1, spread_in_box(2), {}), std::invalid_argument);
  EXPECT_THROW(DisplacementLattice(kBox, 0, Between::linear, 1, {}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace dressform
