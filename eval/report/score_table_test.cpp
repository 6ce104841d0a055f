#include "eval/report/score_table.h"

#include <gtest/gtest.h>

#include <limits>

namespace dressform {
namespace {

TEST(ScoreTable, JudgesAgainstTheTargets) {
  Scores scores{"scene", "default", 1, {}};
  scores.rows = {{"registration", "max/rotation_deg@1", "deg", 0.6, "ok", 3},
                 {"surface", "bottom/f_5mm@1", "1", 0.9, "ok", 3},
                 {"surface", "top/f_5mm@1", "1", std::numeric_limits<double>::quiet_NaN(), "failed", 0},
                 {"fit", "top/ease_hip_change_mm@3", "mm", -14, "ok", 1},
                 {"fit", "bottom/ease_chest_change_mm@3", "mm", std::numeric_limits<double>::quiet_NaN(), "absent", 0}};
  const auto lines = score_lines(scores);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_TRUE(lines[0].missed());
  EXPECT_EQ(lines[0].value, "0.600 deg");
  EXPECT_EQ(lines[1].part, "top");
  EXPECT_TRUE(lines[1].missed()) << "a failed measure never counts as met";
  EXPECT_FALSE(lines[2].missed());
  EXPECT_TRUE(lines[2].judged());
  EXPECT_FALSE(lines[4].judged()) << "what the truth does not have is not judged";
  EXPECT_NE(score_table_text(scores).find("2 of 4 targets met"), std::string::npos);
}

}  // namespace
}  // namespace dressform
