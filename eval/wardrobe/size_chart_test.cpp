#include "eval/wardrobe/size_chart.h"

#include <gtest/gtest.h>

#include "scenes/error.h"

namespace dressform {
namespace {

TEST(SizeChart, LettersStandForTheStandardsGirths) {
  const auto men = size_chart("men"), women = size_chart("women");
  ASSERT_EQ(men.size(), 6u);
  ASSERT_EQ(women.size(), 6u);
  EXPECT_EQ(men[2].name, "M");
  EXPECT_NEAR(men[2].chest_m, 0.98, 1e-9);
  EXPECT_NEAR(men[2].waist_m, 0.86, 1e-9);
  EXPECT_NEAR(women[1].chest_m, 0.86, 1e-9);
  EXPECT_NEAR(women[1].waist_m, 0.70, 1e-9);
  EXPECT_NEAR(women[1].hip_m, 0.94, 1e-9);
  for (const auto& chart : {men, women})
    for (std::size_t i = 1; i < chart.size(); ++i) {
      EXPECT_EQ(chart[i].chest_low_m, chart[i - 1].chest_high_m);
      EXPECT_GT(chart[i].hip_m, chart[i - 1].hip_m);
      EXPECT_LT(chart[i].waist_m, chart[i].chest_m);
    }
  EXPECT_THROW(size_chart("cats"), InputError);
}

TEST(SizeChart, AChestFindsItsLetter) {
  const auto men = size_chart("men");
  EXPECT_EQ(class_of_chest(men, 1.01).name, "M");
  EXPECT_EQ(class_of_chest(men, 1.02).name, "L");
  EXPECT_EQ(class_of_chest(men, 0.60).name, "XS");
  EXPECT_EQ(class_of_chest(men, 1.80).name, "XXL");
}

}  // namespace
}  // namespace dressform
