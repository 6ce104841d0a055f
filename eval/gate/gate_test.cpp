#include "eval/gate/gate.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

namespace dressform {
namespace {

namespace fs = std::filesystem;

Scores some_scores() {
  Scores scores{"group1", "default", 1, {}};
  scores.rows = {{"registration", "k2/rotation_deg@1", "deg", 0.2, "ok", 10},
                 {"surface", "top/f_5mm@1", "1", 0.93, "ok", 1000},
                 {"open", "top/loops@1", "count", 4, "ok", 1},
                 {"fit", "bottom/ease_waist_change_mm@1", "mm", std::numeric_limits<double>::quiet_NaN(), "failed", 0}};
  return scores;
}

std::map<std::string, cv::Mat> some_images(int level = 100) {
  return {{"result", cv::Mat(20, 30, CV_8UC3, cv::Scalar::all(level))}};
}

GoldenCase some_case() {
  GoldenCase empty;
  empty.name = "group1";
  empty.scene = "scenes/library/group1.toml";
  return accepted(empty, some_scores(), some_images(), "first");
}

class GateFiles : public testing::Test {
 protected:
  void SetUp() override {
    golden_ = fs::path(testing::TempDir()) /
              (std::string("golden_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(golden_);
  }
  void TearDown() override { fs::remove_all(golden_); }
  fs::path golden_;
};

TEST(Gate, TheSameRunPasses) {
  const auto result = compare_with_golden(some_case(), some_scores(), some_images());
  EXPECT_EQ(result.verdict, GateVerdict::pass);
  EXPECT_EQ(result.compared, 5);
}

TEST(Gate, ANumberBeyondItsToleranceIsARegression) {
  for (std::size_t i = 0; i < 3; ++i) {
    auto scores = some_scores();
    scores.rows[i].value += 1.5 * nuisance_tolerance(scores.rows[i]) + 1e-9;
    const auto result = compare_with_golden(some_case(), scores, some_images());
    EXPECT_EQ(result.verdict, GateVerdict::regression) << i;
    EXPECT_EQ(result.findings.size(), 1u);
  }
}

TEST(Gate, MissingNumbersOtherStatusAndOtherImagesAreRegressions) {
  auto fewer = some_scores();
  fewer.rows.pop_back();
  EXPECT_EQ(compare_with_golden(some_case(), fewer, some_images()).verdict, GateVerdict::regression);
  auto failed = some_scores();
  failed.rows[1].status = "failed";
  EXPECT_EQ(compare_with_golden(some_case(), failed, some_images()).verdict, GateVerdict::regression);
  EXPECT_EQ(compare_with_golden(some_case(), some_scores(), some_images(103)).verdict, GateVerdict::regression);
  EXPECT_EQ(compare_with_golden(some_case(), some_scores(), {}).verdict, GateVerdict::regression);
}

TEST(Gate, NumbersThatTheReferenceDoesNotKnowMakeItObsolete) {
  auto more = some_scores();
  more.rows.push_back({"fit", "new@1", "mm", 1, "ok", 1});
  EXPECT_EQ(compare_with_golden(some_case(), more, some_images()).verdict, GateVerdict::obsolete);
}

TEST(Gate, AcceptTouchesOnlyWhatIsBeyondTolerance) {
  auto scores = some_scores();
  scores.rows[0].value += 0.1 * nuisance_tolerance(scores.rows[0]);  // would creep, were it accepted
  scores.rows[1].value = 0.5;
  const auto next = accepted(some_case(), scores, some_images(), "worse on purpose");
  EXPECT_EQ(next.scores[0].row.value, 0.2);
  EXPECT_EQ(next.scores[1].row.value, 0.5);
  ASSERT_EQ(next.history.size(), 2u);
  EXPECT_NE(next.history[1].find("0.93 -> 0.5"), std::string::npos);
}

TEST_F(GateFiles, RoundTrip) {
  write_golden_case(golden_, some_case());
  const auto read = read_golden_case(golden_, "group1");
  EXPECT_EQ(compare_with_golden(read, some_scores(), some_images()).verdict, GateVerdict::pass);
  EXPECT_EQ(golden_case_names(golden_), std::vector<std::string>{"group1"});
}

TEST_F(GateFiles, MissingEmptyAndCorruptReferencesFail) {
  EXPECT_THROW(golden_case_names(golden_), GoldenError);
  EXPECT_THROW(read_golden_case(golden_, "group1"), GoldenError);
  write_golden_case(golden_, some_case());
  fs::resize_file(golden_ / "group1/golden.json", 30);
  EXPECT_THROW(read_golden_case(golden_, "group1"), GoldenError);
  GoldenCase empty = some_case();
  empty.scores.clear();
  write_golden_case(golden_, empty);
  EXPECT_THROW(read_golden_case(golden_, "group1"), GoldenError);
  write_golden_case(golden_, some_case());
  fs::remove(golden_ / "group1/result.png");
  EXPECT_THROW(read_golden_case(golden_, "group1"), GoldenError);
  auto other = some_case();
  other.images = some_images(7);
  write_golden_case(golden_, some_case());
  const auto bytes = fs::file_size(golden_ / "group1/result.png");
  fs::resize_file(golden_ / "group1/result.png", bytes / 2);
  EXPECT_THROW(read_golden_case(golden_, "group1"), GoldenError);
}

}  // namespace
}  // namespace dressform
