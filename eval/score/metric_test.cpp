#include "eval/score/metric.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "eval/score/metric_family.h"
#include "eval/score/targets.h"

namespace dressform {
namespace {

using Members = std::vector<std::string>;

TEST(Metric, NamesItsRowsAndKnowsThem) {
  const Metric metric{"<slot>/rim_<rim>_hd95_mm", 2, "mm", Better::lower, "x"};
  EXPECT_EQ(metric.row_name({"top", "left_cuff"}), "top/rim_left_cuff_hd95_mm@2");
  EXPECT_EQ(metric.members_of("top/rim_left_cuff_hd95_mm@2"), (Members{"top", "left_cuff"}));
  for (const char* other : {"top/rim_left_cuff_hd95_mm@1", "top/rim__hd95_mm@2", "top/rim_neck_chamfer_mm@2", "",
                            "/rim_neck_hd95_mm@2", "top/rim_neck_hd95_mm@2 ", "a/b/rim_neck_hd95_mm@2"})
    EXPECT_FALSE(metric.members_of(other)) << other;
  EXPECT_THROW(metric.row_name({"top"}), std::logic_error);
  const Metric plain{"unexpected_garments", 1, "count", Better::lower, "x"};
  EXPECT_EQ(plain.row_name({}), "unexpected_garments@1");
  EXPECT_EQ(plain.members_of("unexpected_garments@1"), Members{});
}

TEST(Metric, TargetsFollowTheDirection) {
  const Metric base{"a", 1, "mm", Better::lower, "x"};
  EXPECT_TRUE(base.with_target(2, 1).meets_target(2));
  EXPECT_FALSE(base.with_target(2, 1).meets_target(2.1));
  EXPECT_EQ(base.with_target(2, 1).target_text(), "<= 2 mm");
  const Metric higher{"a", 1, "1", Better::higher, "x"};
  EXPECT_FALSE(higher.with_target(0.85, 1).meets_target(0.84));
  EXPECT_EQ(higher.with_target(0.85, 1).target_text(), ">= 0.85");
  const Metric near{"a", 1, "mm", Better::near_zero, "x"};
  EXPECT_FALSE(near.with_target(15, 1).meets_target(-15.5));
  EXPECT_TRUE(near.with_target(15, 1).meets_target(-14.5));
  EXPECT_EQ(near.with_target(15, 1).target_text(), "within +- 15 mm");
  EXPECT_TRUE(base.meets_target(1e9)) << "there is none";
  EXPECT_EQ(base.target_text(), "");
}

TEST(Metric, OfSeveralThatFitTheMostLiteralIsFound) {
  EXPECT_EQ(find_metric("fit", "top/ease_chest_change_mm@3")->name, "<slot>/ease_<tape>_change_mm");
  EXPECT_EQ(find_metric("fit", "top/ease_chest_mm@3")->name, "<slot>/ease_<tape>_mm");
  EXPECT_EQ(find_metric("segment", "mean/iou_skin@1")->name, "mean/iou_skin");
  EXPECT_EQ(find_metric("segment", "k2/iou_skin@1")->name, "<sensor>/iou_<label>");
  EXPECT_EQ(find_metric("open", "top/rims_hd95_mm@1")->name, "<slot>/rims_hd95_mm");
  EXPECT_EQ(find_metric("open", "top/f_5mm@1"), nullptr) << "of another stage";
  EXPECT_EQ(find_metric("surface", "top/f_7mm@1"), nullptr);
}

// What every declaration must say, and say once.
TEST(Metric, DeclarationsAreWhole) {
  std::set<std::pair<std::string, std::string>> names;
  for (const Metric* metric : all_metrics()) {
    const std::string where = metric->stage + " " + metric->name;
    EXPECT_TRUE(names.insert({metric->stage, metric->name}).second) << where << " is declared twice";
    EXPECT_GE(metric->version, 1) << where;
    EXPECT_FALSE(metric->unit.empty()) << where;
    EXPECT_GT(metric->definition.size(), 7u) << where;
    EXPECT_EQ(metric->definition.back(), '.') << where << ": a definition is a sentence";
    if (!metric->target) continue;
    EXPECT_NE(metric->better, Better::neither) << where << ": a target needs a direction";
    EXPECT_FALSE(metric->headline.empty()) << where << ": a target is shown";
    EXPECT_GT(metric->from_scale, 0) << where;
    EXPECT_LE(metric->from_scale, 1) << where;
  }
  EXPECT_GT(names.size(), 60u);
}

TEST(Metric, FamiliesRunInTheOrderOfTheStages) {
  std::vector<std::string> stages;
  for (const auto* family : metric_families()) stages.push_back(family->stage());
  EXPECT_EQ(stages, (std::vector<std::string>{"calibrate", "fuse", "registration", "segment", "surface", "open",
                                              "texture", "fit", "correct"}));
}

TEST(Metric, NuisanceIsThatOfTheUnitUnlessItHasItsOwn) {
  Metric metric{"a", 1, "mm", Better::lower, "x"};
  EXPECT_DOUBLE_EQ(metric.nuisance().tolerance(-10), 0.25 + 0.2);
  metric.unit = "count";
  EXPECT_EQ(metric.nuisance().tolerance(1000), 0);
  metric.own_nuisance = Nuisance{"pairs", 2, 0};
  EXPECT_EQ(metric.nuisance().tolerance(1000), 2);
}

TEST(Targets, AbsentRowsAreNotJudgedAndFailedOnesMissed) {
  Scores scores{"s", "default", 1, {}};
  const double none = std::numeric_limits<double>::quiet_NaN();
  scores.rows = {{"registration", "k2/rotation_deg@1", "deg", 9, "ok", 1},
                 {"registration", "max/rotation_deg@1", "deg", 0.4, "ok", 1},
                 {"surface", "top/f_5mm@1", "1", none, "failed", 0},
                 {"fit", "top/ease_hip_change_mm@3", "mm", none, "absent", 0}};
  const auto results = target_results(scores);
  ASSERT_EQ(results.size(), 2u) << "the target is for the worst sensor alone";
  EXPECT_TRUE(results[0].met);
  EXPECT_EQ(results[0].value_text(), "0.400 deg");
  EXPECT_FALSE(results[1].met);
  EXPECT_EQ(results[1].name(), "surface top/f_5mm@1");
}

}  // namespace
}  // namespace dressform
