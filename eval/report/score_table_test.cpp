#include "eval/report/score_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "eval/score/metric.h"
#include "scenes/file_bytes.h"

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
  EXPECT_NE(score_table_text(scores, 0.4).find("2 of the missed are meant to hold at a larger scale than 0.4 only"),
            std::string::npos);
  EXPECT_EQ(score_table_text(scores, 1.0), score_table_text(scores));
}

// Whether a metric declares a line of a printed table: its part, words and target.
bool declares(const Metric& metric, const std::string& part, const std::string& line) {
  const bool of_garment = metric.name.rfind("<slot>/", 0) == 0;
  if (metric.headline.empty() || (of_garment ? part != "top" && part != "bottom" : part != metric.stage)) return false;
  const std::size_t open = metric.headline.find('<'), close = metric.headline.find('>');
  const std::string before = metric.headline.substr(0, open),
                    after = close == std::string::npos ? "" : metric.headline.substr(close + 1);
  const bool judged = line.find("<=") != std::string::npos || line.find(">=") != std::string::npos ||
                      line.find("within +-") != std::string::npos;
  if (line.find(before) == std::string::npos || line.find(after) == std::string::npos) return false;
  if (line.find("absent") != std::string::npos) return !judged;
  return judged == metric.target.has_value() && line.find(metric.target_text()) != std::string::npos;
}

// The words and targets of README's example are those that the program prints.
TEST(ScoreTable, ReadmeShowsTheLinesThatAreDeclared) {
  const std::string readme = read_file_bytes(std::filesystem::path(DRESSFORM_SOURCE_DIR) / "README.md");
  std::istringstream lines(readme.substr(readme.find("scores of group1 (seed 1, default)")));
  std::string line;
  std::getline(lines, line);
  int shown = 0;
  for (; std::getline(lines, line) && line.rfind("  ", 0) == 0; ++shown) {
    const std::string part = line.substr(2, line.find(' ', 2) - 2);
    const auto metrics = all_metrics();
    EXPECT_TRUE(std::any_of(metrics.begin(), metrics.end(), [&](const Metric* metric) {
      return declares(*metric, part, line);
    })) << line;
  }
  EXPECT_GT(shown, 30);
}

}  // namespace
}  // namespace dressform
