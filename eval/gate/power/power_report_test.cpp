#include "eval/gate/power/power_report.h"

#include <gtest/gtest.h>

namespace dressform {
namespace {

PowerCell told(const std::string& fault, const std::string& step, std::size_t size, int placement, bool found,
               const std::string& by_bytes, const std::string& by_numbers) {
  return {"group1", fault, step, size, placement, found, false, by_bytes, by_numbers, ""};
}

TEST(PowerReport, TheSizeFoundIsTheSmallestFromWhichOnAllAreFound) {
  const auto faults = chosen_faults({"open.hole"});
  std::vector<PowerCell> cells;
  for (int placement = 0; placement < 4; ++placement) {
    cells.push_back(told("open.hole", "open", 0, placement, placement == 0, "open", placement == 0 ? "open" : ""));
    cells.push_back(told("open.hole", "open", 1, placement, true, "open", "open"));
    cells.push_back(told("open.hole", "open", 2, placement, true, "open", "open"));
  }
  const auto curve = detection_curves(faults, cells).at(0);
  ASSERT_EQ(curve.sizes.size(), 3u);
  EXPECT_EQ(curve.sizes[0].found, 1);
  EXPECT_EQ(curve.sizes[0].placed, 4);
  EXPECT_EQ(curve.size_found, faults[0].sizes[1]);
  EXPECT_NEAR(curve.sizes[1].at_least, 0.5101, 1e-3) << "Wilson's for 4 of 4";
  const std::string text = curves_text({curve});
  EXPECT_NE(text.find("medium: 4 of 4 found"), std::string::npos) << text;
  EXPECT_NE(text.find("from 50 mm"), std::string::npos) << text;
}

TEST(PowerReport, ALargeFaultThatIsMissedAndOneWithoutEffectAreSaid) {
  const auto faults = chosen_faults({"open.hole"});
  const auto curve = detection_curves(faults, {told("open.hole", "open", 2, 0, false, "open", ""),
                                               told("open.hole", "open", 1, 0, false, "", "")})
                         .at(0);
  EXPECT_FALSE(curve.size_found);
  EXPECT_EQ(curve.without_effect, 1);
  ASSERT_EQ(curve.sizes.size(), 1u) << "where nothing changed there was nothing to find";
  EXPECT_NE(curves_text({curve}).find("NOT FOUND"), std::string::npos);
  EXPECT_NE(curves_text({curve}).find("open.hole of 120 mm: 0 of 1"), std::string::npos);
}

TEST(PowerReport, ACrashIsFoundAndBlamesNobody) {
  PowerCell crash = told("open.hole", "open", 2, 0, true, "", "");
  crash.crashed = true;
  EXPECT_EQ(detection_curves(chosen_faults({"open.hole"}), {crash}).at(0).sizes.at(0).found, 1);
  EXPECT_EQ(blame_by_bytes({crash}).total, 0);
}

TEST(PowerReport, BlameIsCountedByStep) {
  Scores scores;
  scores.rows = {{"segment", "mean/iou_top@1", "1", 0.9, "ok", 1}, {"surface", "top/f_5mm@1", "1", 0.9, "ok", 1}};
  const std::vector<PowerCell> cells{told("segment.shifted", "segment", 0, 0, true, "segment", "segment"),
                                     told("segment.bled", "segment", 0, 0, true, "segment", "surface"),
                                     told("fill.deepened", "fill", 0, 0, true, "fill", "surface"),
                                     told("fill.tinted", "fill", 0, 0, true, "fill", "segment"),
                                     told("image.hole", "image", 0, 0, true, "image result_user", "image"),
                                     told("open.hole", "open", 0, 0, false, "fit", "")};
  const auto bytes = blame_by_bytes(cells);
  EXPECT_EQ(bytes.total, 6);
  EXPECT_EQ(bytes.right, 5);
  EXPECT_EQ(bytes.counts.at("open").at("fit"), 1);
  const auto numbers = blame_by_numbers(cells, scores);
  EXPECT_EQ(numbers.total, 5) << "what was not found is nobody's";
  EXPECT_EQ(numbers.right, 3) << "segment's own; fill has no numbers, surface comes after it; the picture";
  EXPECT_NE(blame_text(numbers, "by numbers").find("right in 3 of 5 (60 %)"), std::string::npos);
  EXPECT_EQ(blame_text({}, "x"), "x: nothing to blame\n");
}

TEST(PowerRun, ACaseIsItsOwnReferenceAndAFaultInItsNumbersIsFoundAndBlamed) {
  PowerBase base;
  base.name = "group1";
  base.run.scores = {"group1", "default", 1, {{"surface", "top/f_5mm@1", "1", 0.7, "ok", 1}}};  // misses its target
  base.run.images = {{"result", cv::Mat(40, 40, CV_8UC3, cv::Scalar::all(100))}};
  base.run.steps = {{"surface", "s", "i"}, {"scores", "n", "i"}, {"image result", "p", "i"}};
  base.reference = reference_of("group1", base.run);
  const PowerRequest request{std::filesystem::path(testing::TempDir()) / "no_cells", 1};
  const auto ratios = chosen_faults({"scores.ratios_low"}).at(0);
  const auto cell = power_cell(base, ratios, 2, 0, request, {});
  EXPECT_TRUE(cell.found);
  EXPECT_EQ(cell.by_bytes, "scores");
  EXPECT_EQ(cell.by_numbers, "surface");
  const auto hole = power_cell(base, chosen_faults({"image.hole"}).at(0), 1, 0, request, {});
  EXPECT_TRUE(hole.found);
  EXPECT_EQ(hole.by_bytes, "image result");
  EXPECT_EQ(hole.by_numbers, "image");
  EXPECT_FALSE(judged_cell(base, ratios, 0, 0, base.run, {}).found) << "without a fault";
}

}  // namespace
}  // namespace dressform
