#include <gtest/gtest.h>

#include <set>

#include "eval/score/evaluate.h"
#include "eval/testing/judged_figure.h"

namespace dressform {
namespace {

using namespace judged_figure;

// What the truth does not have is absent; what it has is scored as ever.
class EvaluatePartOfTheTruth : public testing::Test {
 protected:
  // The statuses of all rows of a stage whose names contain `part`.
  static std::set<std::string> statuses(const Scores& scores, const std::string& stage, const std::string& part = "") {
    std::set<std::string> result;
    for (const auto& row : scores.rows)
      if (row.stage == stage && row.metric.find(part) != std::string::npos) result.insert(row.status);
    return result;
  }
  const std::set<std::string> absent{"absent"}, ok{"ok"};
  const GroundTruth whole = some_truth();
  const RunOutputs outputs = perfect_outputs(whole);
};

TEST_F(EvaluatePartOfTheTruth, PosesOnly) {
  GroundTruth truth;
  truth.world_from_sensor = whole.world_from_sensor;
  const Scores scores = evaluate(outputs, truth, quick());
  EXPECT_EQ(statuses(scores, "registration", "rotation"), ok);
  EXPECT_EQ(statuses(scores, "registration", "tre"), absent);
  EXPECT_EQ(statuses(scores, "fuse", "accuracy"), absent);
  EXPECT_EQ(statuses(scores, "segment"), absent);
  EXPECT_EQ(statuses(scores, "surface"), absent);
  EXPECT_EQ(statuses(scores, "open", "rims"), absent);
  EXPECT_EQ(statuses(scores, "open", "loop_difference"), absent);
  EXPECT_EQ(statuses(scores, "texture"), absent);
  EXPECT_EQ(status(scores, "open", "top/loops@1"), "ok");
  EXPECT_EQ(status(scores, "correct", "top/intersecting_pairs@1"), "ok");
}

TEST_F(EvaluatePartOfTheTruth, MeshesWithoutTexture) {
  GroundTruth truth = whole;
  for (auto& [slot, garment] : truth.garments) garment.textured = {};
  const Scores scores = evaluate(outputs, truth, quick());
  EXPECT_EQ(statuses(scores, "texture"), absent);
  EXPECT_EQ(value(scores, "surface", "top/f_5mm@1"), 1);
}

TEST_F(EvaluatePartOfTheTruth, NeitherRimsNorLabelsNorViews) {
  GroundTruth truth = whole;
  truth.rims.clear();
  truth.labels.clear();
  for (auto& [slot, garment] : truth.garments) garment.views.clear();
  const Scores scores = evaluate(outputs, truth, quick());
  EXPECT_EQ(statuses(scores, "open", "rims"), absent);
  EXPECT_EQ(statuses(scores, "segment"), absent);
  EXPECT_EQ(value(scores, "surface", "top/f_5mm@1"), 1);
  EXPECT_GT(value(scores, "texture", "top/ssim_observed@2"), 0.995);
}

TEST_F(EvaluatePartOfTheTruth, WithoutPosesNothingJoinsTheWorld) {
  GroundTruth truth = whole;
  truth.world_from_sensor.clear();
  truth.scan_world_from_sensor.clear();
  const Scores scores = evaluate(outputs, truth, quick());
  EXPECT_EQ(statuses(scores, "registration"), absent);
  EXPECT_EQ(statuses(scores, "surface", "f_5mm"), absent);
  EXPECT_EQ(statuses(scores, "fuse", "accuracy"), absent);
  EXPECT_EQ(statuses(scores, "texture"), absent);
  EXPECT_EQ(value(scores, "open", "top/loop_difference@1"), 0);
  EXPECT_EQ(status(scores, "fit", "naked_body/girth_waist_error_mm@2"), "ok");
}

}  // namespace
}  // namespace dressform
