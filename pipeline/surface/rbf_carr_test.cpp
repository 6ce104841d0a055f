#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/geometry/biharmonic_field.h"
#include "pipeline/surface/signed_samples.h"

namespace dressform {
namespace {

// Two balls of 100 mm radius, 20 mm apart, points spread over both.
PointCloud two_balls(int count) {
  PointCloud cloud;
  for (const double side : {-1.0, 1.0})
    for (int i = 0; i < count; ++i) {
      const double y = 1 - 2 * (i + 0.5) / count, r = std::sqrt(1 - y * y), turn = i * M_PI * (3 - std::sqrt(5.0));
      cloud.normals.emplace_back(r * std::cos(turn), y, r * std::sin(turn));
      cloud.points.push_back(0.1 * cloud.normals.back() + Vector3d(side * 0.11, 0, 0));
    }
  return cloud;
}

double true_distance(const Vector3d& p) {
  return std::min((p - Vector3d(0.11, 0, 0)).norm(), (p + Vector3d(0.11, 0, 0)).norm()) - 0.1;
}

TEST(SignedSamples, LieOnTheirOwnSideOfEverySurface) {
  const PointCloud cloud = two_balls(1000);
  const SignedSamples samples = signed_samples(cloud, 0.04, 0.001, 1);
  EXPECT_GT(samples.points.size(), 2.8 * static_cast<double>(cloud.points.size()));
  int halved = 0;
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    EXPECT_NEAR(samples.distances_m[i], true_distance(samples.points[i]), 0.006);  // half the points' spacing
    halved += samples.distances_m[i] > 0 && samples.distances_m[i] < 0.03;
  }
  EXPECT_GT(halved, 5);  // in the gap
}

TEST(GreedyCentres, FindTwoBallsWithAPartOfTheSamples) {
  const SignedSamples samples = signed_samples(two_balls(1000), 0.02, 0.001, 2);
  GreedyFit fit;
  fit.first_centres = 60;
  fit.most_centres = 900;
  fit.smoothing_m = 0;
  fit.tolerance_m = 0.001;
  const auto centres = greedy_centres(samples, fit);
  ASSERT_FALSE(centres.empty());
  EXPECT_LT(centres.size(), samples.points.size() / 4);
  std::vector<Vector3d> points;
  std::vector<double> values;
  for (const std::size_t i : centres) points.push_back(samples.points[i]), values.push_back(samples.distances_m[i]);
  const BiharmonicField field(points, values, 0);
  for (const Vector3d& p : two_balls(333).points) EXPECT_NEAR(field(p), 0, 0.003);
  EXPECT_GT(field(Vector3d::Zero()), 0.002);  // the gap stays open
  EXPECT_LT(field({0.11, 0, 0}), -0.03);
}

TEST(GreedyCentres, NothingFromNextToNothing) {
  EXPECT_TRUE(greedy_centres({}, {}).empty());
  EXPECT_TRUE(signed_samples({}, 0.01, 0.001, 1).points.empty());
}

}  // namespace
}  // namespace dressform
