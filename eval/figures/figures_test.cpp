#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "eval/figures/figure_list.h"
#include "eval/figures/study_figures.h"
#include "eval/figures/write_figures.h"
#include "scenes/error.h"

namespace dressform {
namespace {

using testing::HasSubstr;

TEST(FigureList, HasEveryFigureOfBothChaptersOnce) {
  std::vector<std::string> expected;
  for (int n = 2; n <= 40; ++n) expected.push_back("3." + std::to_string(n));
  for (int n = 1; n <= 17; ++n) expected.push_back("4." + std::to_string(n));
  std::vector<std::string> numbers;
  std::set<std::string> stems;
  for (const auto& figure : thesis_figures_list()) {
    numbers.push_back(figure.number);
    stems.insert(figure.stem());
    EXPECT_EQ(figure.make == nullptr, !figure.reason.empty()) << figure.number;
    EXPECT_FALSE(figure.shows.empty() || figure.name.empty()) << figure.number;
  }
  EXPECT_EQ(numbers, expected);
  EXPECT_EQ(stems.size(), expected.size());
}

TEST(FigureList, StagesAreThoseOfThePipeline) {
  std::set<std::string> known{"capture"};
  for (const auto& stage : describe_stages()) known.insert(stage.name);
  for (const auto& figure : thesis_figures_list()) EXPECT_EQ(known.count(figure.stage), 1u) << figure.stage;
}

TEST(FigureList, FindsByNumberAndByName) {
  EXPECT_EQ(thesis_figure("3.40").name, "resized");
  EXPECT_EQ(thesis_figure("registered").number, "3.13");
  try {
    thesis_figure("3.41");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("3.41"));
    EXPECT_THAT(error.what(), HasSubstr("3.40 resized"));
  }
}

// Values 1, 2 and 4 of four scenes, one of which failed.
TEST(SuccessCurve, CountsAFailureAsNeverWithin) {
  const Curve lower = success_curve("a", 1, {4, 1, 2}, 4, Better::lower);
  ASSERT_EQ(lower.points.size(), 6u);
  EXPECT_EQ(lower.points.front(), Eigen::Vector2d(1, 0));
  EXPECT_EQ(lower.points[1], Eigen::Vector2d(1, 0.25));
  EXPECT_EQ(lower.points.back(), Eigen::Vector2d(4, 0.75));
  const Curve higher = success_curve("a", 1, {4, 1, 2}, 4, Better::higher);
  EXPECT_EQ(higher.points.front(), Eigen::Vector2d(1, 0.75));
  EXPECT_EQ(higher.points.back(), Eigen::Vector2d(4, 0));
  EXPECT_EQ(success_curve("a", 1, {}, 3, Better::lower).points.front(), Eigen::Vector2d(0, 0));
}

TEST(FigureTable, SaysWhyThereIsNone) {
  const std::string text = figures_markdown(
      "Figures of x",
      {{"3.2", "checkerboard", "capture", "a | b", "no boards", {}}, {"3.3", "n", "s", "w", "", {"a.png", "a.pdf"}}});
  EXPECT_THAT(text, HasSubstr("| 3.2 | checkerboard | capture | a \\| b | none: no boards |"));
  EXPECT_THAT(text, HasSubstr("| a.png, a.pdf |"));
}

}  // namespace
}  // namespace dressform
