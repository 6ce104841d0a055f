#include "scenes/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "scenes/wide_math.h"

namespace dressform {
namespace {

TEST(Random, BulkNormalsAreTheNumbersOfNormal4) {
  std::vector<float> bulk(3 * normal_block);
  fill_normals(5, stream_of("x"), 1ull << 33, 3, bulk.data());
  constexpr int counters = normal_block / 4;
  for (int block = 0; block < 3; ++block)
    for (int i = 0; i < counters; ++i) {
      const auto expected = normal4(5, stream_of("x"), ((1ull << 33) + block) * counters + i);
      for (int k = 0; k < 4; ++k)
        EXPECT_NEAR(bulk[block * normal_block + k * counters + i], expected[k], 2e-5 * (1 + std::abs(expected[k])));
    }
}

TEST(Random, BulkNormalsHaveNormalMoments) {
  std::vector<float> bulk(2000 * normal_block);
  fill_normals(1, 2, 0, 2000, bulk.data());
  double moment[5] = {};
  for (const double x : bulk)
    for (int k = 1; k <= 4; ++k) moment[k] += std::pow(x, k) / bulk.size();
  EXPECT_NEAR(moment[1], 0, 0.006);
  EXPECT_NEAR(moment[2], 1, 0.01);
  EXPECT_NEAR(moment[3], 0, 0.03);
  EXPECT_NEAR(moment[4], 3, 0.06);
}

TEST(WideMath, AgreesWithTheLibrary) {
  for (int i = -4000; i <= 4000; ++i) {
    const float x = i * 0.0125f;
    float s, c;
    wide::sincos_of_turns(x, s, c);
    EXPECT_NEAR(s, std::sin(2 * M_PI * x), 1e-6) << x;
    EXPECT_NEAR(c, std::cos(2 * M_PI * x), 1e-6) << x;
    EXPECT_NEAR(wide::exp2(x) / std::exp2(static_cast<double>(x)), 1, 4e-7) << x;
    if (x > 0) {
      EXPECT_NEAR(wide::log(x), std::log(static_cast<double>(x)), 5e-7) << x;
    }
    if (x >= 0 && x <= 1) {
      EXPECT_NEAR(wide::acos(x), std::acos(x), 1e-4) << x;
    }
    const double angle = 1e-3 * i, turns = angle / (2 * M_PI) - std::floor(angle / (2 * M_PI));
    const float measured =
        wide::turns_of(static_cast<float>(3 * std::cos(angle)), static_cast<float>(3 * std::sin(angle)));
    EXPECT_NEAR(std::remainder(measured - turns, 1.0), 0, 2e-7) << angle;
    EXPECT_LT(measured, 1);
    EXPECT_GE(measured, 0);
  }
  EXPECT_EQ(wide::turns_of(0, 0), 0);
}

}  // namespace
}  // namespace dressform
