#include "eval/gate/gate.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "eval/gate/accept.h"
#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

const std::string kWaist = "fit bottom/ease_waist_change_mm@3", kRotation = "registration max/rotation_deg@1",
                  kF = "surface top/f_5mm@1";

Scores some_scores() {
  Scores scores{"group1", "default", 1, {}};
  scores.rows = {{"registration", "max/rotation_deg@1", "deg", 0.2, "ok", 10},
                 {"surface", "top/f_5mm@1", "1", 0.93, "ok", 1000},
                 {"open", "top/loops@1", "count", 4, "ok", 1},
                 {"fit", "bottom/ease_waist_change_mm@3", "mm", std::numeric_limits<double>::quiet_NaN(), "failed", 0}};
  return scores;
}

std::map<std::string, cv::Mat> some_images(int level = 100) {
  return {{"result", cv::Mat(20, 30, CV_8UC3, cv::Scalar::all(level))}};
}

using Images = std::map<std::string, cv::Mat>;

GateResult compared(const GoldenCase& golden, const Scores& scores, const Images& images) {
  return compare_with_golden(golden, {scores, images, {}, {}});
}

GoldenCase accepted_all(const GoldenCase& golden, const Scores& scores, const Images& images, const std::string& reason,
                        const std::map<std::string, std::string>& miss_reasons = {}) {
  return accepted(golden, {scores, images, {}, {}}, {reason, {}, miss_reasons}).golden;
}

GoldenCase some_case() {
  GoldenCase empty;
  empty.name = "group1";
  empty.scene = "scenes/library/group1.toml";
  return accepted_all(empty, some_scores(), some_images(), "first", {{kWaist, "no tape goes round it"}});
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
  const auto result = compared(some_case(), some_scores(), some_images());
  EXPECT_EQ(result.verdict, GateVerdict::pass);
  EXPECT_EQ(result.compared, 5);
}

TEST(Gate, ANumberBeyondItsToleranceIsARegression) {
  for (std::size_t i = 0; i < 3; ++i) {
    auto scores = some_scores();
    const double worse = i == 1 ? -1 : 1;
    scores.rows[i].value += worse * (1.5 * nuisance_tolerance(scores.rows[i]) + 1e-9);
    const auto result = compared(some_case(), scores, some_images());
    EXPECT_EQ(result.verdict, GateVerdict::regression) << i;
    EXPECT_EQ(result.findings.size(), 1u);
  }
}

TEST(Gate, MissingNumbersOtherStatusAndOtherImagesAreRegressions) {
  auto fewer = some_scores();
  fewer.rows.pop_back();
  EXPECT_EQ(compared(some_case(), fewer, some_images()).verdict, GateVerdict::regression);
  auto failed = some_scores();
  failed.rows[1].status = "failed";
  EXPECT_EQ(compared(some_case(), failed, some_images()).verdict, GateVerdict::regression);
  EXPECT_EQ(compared(some_case(), some_scores(), some_images(103)).verdict, GateVerdict::regression);
  EXPECT_EQ(compared(some_case(), some_scores(), {}).verdict, GateVerdict::regression);
}

TEST(Gate, ABetterNumberPassesAndAsksToBeAccepted) {
  auto scores = some_scores();
  scores.rows[0].value = 0.1;
  scores.rows[1].value = 0.97;
  const auto result = compared(some_case(), scores, some_images());
  EXPECT_EQ(result.verdict, GateVerdict::pass);
  ASSERT_EQ(result.better.size(), 2u);
  EXPECT_EQ(result.better[0].what(), kRotation);
  scores.rows[2].value = 3;  // a number of openings has no better direction
  EXPECT_EQ(compared(some_case(), scores, some_images()).verdict, GateVerdict::regression);
}

TEST(Gate, TargetsMetAndMissedAreTold) {
  const auto result = compared(some_case(), some_scores(), some_images());
  ASSERT_EQ(result.targets.size(), 3u) << "one a row with a target";
  EXPECT_EQ(result.targets[0].metric, kRotation);
  EXPECT_TRUE(result.targets[0].met);
  EXPECT_EQ(result.targets[0].target, "<= 0.5 deg");
  EXPECT_EQ(result.targets[2].metric, kWaist);
  EXPECT_FALSE(result.targets[2].met) << "what failed missed its target";
  EXPECT_EQ(result.targets[2].known, "no tape goes round it");
}

TEST(Gate, ANewlyMissedTargetIsARegressionByNameHoweverSmallTheChange) {
  GoldenCase golden = some_case();
  auto scores = some_scores();
  golden.scores[0].row.value = golden.scores[0].first = 0.495;
  scores.rows[0].value = 0.505;  // within the nuisance of 0.02 degrees
  const auto result = compared(golden, scores, some_images());
  EXPECT_EQ(result.verdict, GateVerdict::regression);
  ASSERT_EQ(result.findings.size(), 1u);
  EXPECT_EQ(result.findings[0].what(), kRotation + " (target)");
  golden.known_misses[kRotation] = "the scan is short";
  EXPECT_EQ(compared(golden, scores, some_images()).verdict, GateVerdict::pass);
}

TEST(Gate, AKnownMissThatIsMetNowAsksToBeAccepted) {
  GoldenCase golden = some_case();
  golden.known_misses[kF] = "holes under the arms";
  const auto result = compared(golden, some_scores(), some_images());
  EXPECT_EQ(result.verdict, GateVerdict::pass);
  ASSERT_EQ(result.better.size(), 1u);
  EXPECT_NE(result.better[0].message.find("holes under the arms"), std::string::npos);
  EXPECT_EQ(accepted_all(golden, some_scores(), some_images(), "met").known_misses.count(kF), 0u);
}

TEST(Gate, AcceptWantsAReasonForEveryMiss) {
  auto scores = some_scores();
  scores.rows[1].value = 0.7;
  try {
    accepted_all(some_case(), scores, some_images(), "worse on purpose");
    FAIL() << "a miss was accepted without a reason";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(kF + " (0.700, target >= 0.85)"), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find(kWaist), std::string::npos) << "its reason is known";
  }
  const auto next = accepted_all(some_case(), scores, some_images(), "worse on purpose", {{kF, "coarser voxels"}});
  EXPECT_EQ(next.known_misses,
            (std::map<std::string, std::string>{{kF, "coarser voxels"}, {kWaist, "no tape goes round it"}}));
  EXPECT_THROW(accepted_all(some_case(), scores, some_images(), "x", {{kF, "why"}, {kRotation, "not missed"}}),
               InputError);
}

TEST(Gate, ARowThatNobodyDeclaredCannotBeAccepted) {
  auto scores = some_scores();
  scores.rows.push_back({"fit", "new@1", "mm", 1, "ok", 1});
  EXPECT_THROW(accepted_all(some_case(), scores, some_images(), "x"), std::logic_error);
}

TEST(Gate, NumbersThatTheReferenceDoesNotKnowMakeItObsolete) {
  auto more = some_scores();
  more.rows.push_back({"fit", "new@1", "mm", 1, "ok", 1});
  EXPECT_EQ(compared(some_case(), more, some_images()).verdict, GateVerdict::obsolete);
}

TEST(Gate, AcceptTouchesOnlyWhatIsBeyondTolerance) {
  auto scores = some_scores();
  scores.rows[0].value += 0.1 * nuisance_tolerance(scores.rows[0]);  // would creep, were it accepted
  scores.rows[1].value = 0.5;
  const auto next = accepted_all(some_case(), scores, some_images(), "worse on purpose", {{kF, "on purpose"}});
  EXPECT_EQ(next.scores[0].row.value, 0.2);
  EXPECT_EQ(next.scores[1].row.value, 0.5);
  ASSERT_EQ(next.history.size(), 2u);
  EXPECT_NE(next.history[1].find("0.93 -> 0.5"), std::string::npos);
}

TEST(Gate, TheSameNumberIsIdenticalAndASmallStepIsWithinNuisance) {
  auto scores = some_scores();
  scores.rows[0].value += 0.001;
  const auto result = compared(some_case(), scores, some_images());
  EXPECT_EQ(result.items[0].verdict, ItemVerdict::within);
  EXPECT_NEAR(result.items[0].times, 0.001 / 0.02, 1e-9);
  EXPECT_EQ(result.items[1].verdict, ItemVerdict::same);
  EXPECT_NE(result.items[0].message.find("declared, not measured"), std::string::npos);
  EXPECT_EQ(result.unmeasured.size(), 3u) << "what failed has no tolerance";
}

TEST(Gate, FindingsAndStagesComeWorstFirst) {
  auto scores = some_scores();
  scores.rows[0].value += 0.03;  // 1.5 tolerances
  scores.rows[1].value -= 0.05;  // 5
  const auto result = compared(some_case(), scores, some_images());
  ASSERT_EQ(result.findings.size(), 2u);
  EXPECT_EQ(result.findings[0].what(), kF);
  EXPECT_EQ(result.findings[1].what(), kRotation);
  EXPECT_EQ(result.stages[0].stage, "surface");
  EXPECT_EQ(result.blame, "registration") << "no bytes tell: the first stage of the pipeline that fails";
  EXPECT_EQ(result.stages[1].stage, "registration");
  EXPECT_EQ(result.stages[0].counts.at(ItemVerdict::worse), 1);
}

TEST_F(GateFiles, RoundTrip) {
  write_golden_case(golden_, some_case());
  const auto read = read_golden_case(golden_, "group1");
  EXPECT_EQ(compared(read, some_scores(), some_images()).verdict, GateVerdict::pass);
  EXPECT_EQ(read.known_misses, some_case().known_misses);
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
  auto without_reason = some_case();
  without_reason.known_misses[kWaist] = "";
  write_golden_case(golden_, without_reason);
  EXPECT_THROW(read_golden_case(golden_, "group1"), GoldenError);
  write_golden_case(golden_, some_case());
  const auto bytes = fs::file_size(golden_ / "group1/result.png");
  fs::resize_file(golden_ / "group1/result.png", bytes / 2);
  EXPECT_THROW(read_golden_case(golden_, "group1"), GoldenError);
}

}  // namespace
}  // namespace dressform
