#include "scenes/statistics.h"

#include <gtest/gtest.h>

#include <limits>

namespace dressform {
namespace {

TEST(Statistics, TheUpperMedianIsAValueThatOccurs) {
  EXPECT_EQ(median<double>({7}), 7);
  EXPECT_EQ(median<double>({3, 1, 2}), 2);
  EXPECT_EQ(median<int>({4, 1, 3, 2}), 3);
  EXPECT_EQ(median<float>({5, 5, 5, 1}), 5);
  EXPECT_EQ(median_or<double>({}, -1), -1);
  EXPECT_EQ(median_or<double>({4}, -1), 4);
  EXPECT_THROW(median<double>({}), std::logic_error);
}

TEST(Statistics, PlacesAndQuantilesRoundDown) {
  const std::vector<int> values{50, 10, 40, 20, 30};
  for (int place = 0; place < 5; ++place) EXPECT_EQ(nth_value(values, place), 10 * (place + 1));
  EXPECT_THROW(nth_value(values, 5), std::logic_error);
  EXPECT_EQ(lower_quantile(values, 0), 10);
  EXPECT_EQ(lower_quantile(values, 0.49), 20);
  EXPECT_EQ(lower_quantile(values, 0.5), 30);
  EXPECT_EQ(lower_quantile(values, 0.99), 40);
  EXPECT_EQ(lower_quantile(values, 1), 50);
  EXPECT_THROW(lower_quantile(std::vector<int>{}, 0.5), std::logic_error);
}

TEST(Statistics, TukeyWeighsAndSaturates) {
  EXPECT_EQ(Tukey(0).weight, 1);
  EXPECT_EQ(Tukey(0).loss, 0);
  EXPECT_DOUBLE_EQ(Tukey(-0.5).weight, 0.5625);
  EXPECT_DOUBLE_EQ(Tukey(0.5).loss, 1 - 0.421875);
  EXPECT_EQ(Tukey::of_square(0.25).weight, Tukey(0.5).weight);
  for (const double far : {1.0, -1.0, 1e9, std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(Tukey(far).weight, 0) << far;
    EXPECT_EQ(Tukey(far).loss, 1) << far;
  }
}

}  // namespace
}  // namespace dressform
