#include "eval/studies/study_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dressform {
namespace {

using Mark = StudyTable::Cell::Mark;
using testing::ElementsAre;
using testing::HasSubstr;

Comparison compared_as(double effect, double half, Verdict verdict) {
  Comparison comparison;
  comparison.effect = effect;
  comparison.interval = Interval{effect - half, effect + half};
  comparison.verdict = verdict;
  return comparison;
}

TEST(StudyTable, MarksOnlyWhatTheVerdictsSupport) {
  const Comparison base = compared_as(0, 0, Verdict::equivalent);
  const Comparison good = compared_as(-2, 0.5, Verdict::better), fair = compared_as(-1, 0.2, Verdict::better);
  const Comparison close = compared_as(-1.9, 0.5, Verdict::better),
                   unsure = compared_as(-0.3, 1, Verdict::inconclusive);
  EXPECT_THAT(supported_marks({&base, &good, &fair}, Better::lower), ElementsAre(Mark::none, Mark::best, Mark::second));
  EXPECT_THAT(supported_marks({&base, &good, &close}, Better::lower), ElementsAre(Mark::none, Mark::none, Mark::none));
  EXPECT_THAT(supported_marks({&base, &unsure}, Better::lower), ElementsAre(Mark::none, Mark::none));
  const Comparison bad = compared_as(3, 1, Verdict::worse);
  EXPECT_THAT(supported_marks({&base, &bad}, Better::lower), ElementsAre(Mark::best, Mark::none));
}

StudyTable small_table() {
  StudyTable table;
  table.caption = "a study";
  table.heads = {"surface <slot>/f_5mm@1", "registration max/tre_mm@1 [mm]"};
  table.variants = {"default", "fast_one"};
  table.rows = {{{"0.950", Mark::best, 0}, {"1.20", Mark::second, 0}},
                {{"0.900", Mark::none, 2}, {"-", Mark::none, 0}}};
  return table;
}

TEST(StudyTable, EveryFormatShowsMarksAndFailures) {
  EXPECT_THAT(study_table_markdown(small_table()), HasSubstr("| default | **0.950** | <u>1.20</u> |"));
  EXPECT_THAT(study_table_markdown(small_table()), HasSubstr("0.900 (2 failed)"));
  const std::string latex = study_table_latex(small_table());
  EXPECT_THAT(latex, HasSubstr("default & \\bfseries 0.950 & {\\underline{1.20}} \\\\"));
  EXPECT_THAT(latex, HasSubstr("fast\\_one & {{0.900}\\,(2 failed)} & {{-}} \\\\"));
  EXPECT_THAT(latex, HasSubstr("{registration max/tre\\_mm@1 [mm]}"));
  EXPECT_THAT(study_table_csv(small_table()), HasSubstr("default,surface <slot>/f_5mm@1,0.950,best,0"));
  EXPECT_THAT(study_table_html(small_table()), HasSubstr("<td class=\"best\">0.950</td>"));
}

}  // namespace
}  // namespace dressform
