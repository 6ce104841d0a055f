#include "pipeline/geometry/biharmonic_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace dressform {
namespace {

std::vector<Vector3d> scattered(int count) {
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) points.emplace_back(std::sin(i * 1.7), std::cos(i * 2.3), std::sin(i * 0.9 + 1));
  return points;
}

TEST(BiharmonicField, LinearFunctionsAreKeptEverywhere) {
  const auto linear = [](const Vector3d& p) { return 2 + p.dot(Vector3d(1, -3, 0.5)); };
  std::vector<double> values;
  for (const Vector3d& p : scattered(40)) values.push_back(linear(p));
  for (const double smoothing_m : {0.0, 0.1})
    EXPECT_NEAR(BiharmonicField(scattered(40), values, smoothing_m)({7, -5, 3}), linear({7, -5, 3}), 1e-8);
}

TEST(BiharmonicField, GoesThroughItsValuesUnlessItMaySmooth) {
  std::vector<double> values;
  for (int i = 0; i < 40; ++i) values.push_back(std::sin(i * 3.1));
  const BiharmonicField exact(scattered(40), values, 0), smooth(scattered(40), values, 5);
  double missed = 0;
  const std::vector<double> found = exact(scattered(40));
  for (int i = 0; i < 40; ++i) {
    EXPECT_NEAR(found[i], values[i], 1e-9);
    missed = std::max(missed, std::abs(smooth(scattered(40)[i]) - values[i]));
  }
  EXPECT_GT(missed, 0.01);
}

TEST(BiharmonicField, RefusesWhatItCannotSolve) {
  EXPECT_THROW(BiharmonicField(scattered(5), {1, 2}, 0), std::invalid_argument);
  EXPECT_THROW(BiharmonicField({}, {}, 0), std::invalid_argument);
  std::vector<Vector3d> flat = scattered(10);
  for (Vector3d& p : flat) p.z() = 1;
  EXPECT_THROW(BiharmonicField(flat, std::vector<double>(10, 1), 0), std::invalid_argument);
}

}  // namespace
}  // namespace dressform
