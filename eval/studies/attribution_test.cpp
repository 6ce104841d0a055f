#include "eval/studies/attribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "eval/studies/run_cells.h"
#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

ReconstructionOptions pipeline_a() { return {}; }
ReconstructionOptions pipeline_b() {
  ReconstructionOptions options;
  options.variants["surface"] = "poisson";
  options.variants["fit"] = "uniform";
  options.values["fuse"]["voxel_m"] = 0.003;
  return options;
}

TEST(Attribution, SwapsEachStageInBothOrders) {
  const AttributionStudy study = attribution_of(pipeline_a(), pipeline_b());
  EXPECT_EQ(study.stages, (std::vector<std::string>{"fuse", "surface", "fit"}));
  std::vector<std::string> names;
  for (const auto& variant : study.variants) names.push_back(variant.name);
  EXPECT_EQ(names, (std::vector<std::string>{"A", "first 1 of B", "first 2 of B", "B", "last 1 of B", "last 2 of B"}));
  EXPECT_EQ(study.variants[1].options.values.count("fuse"), 1u);
  EXPECT_EQ(study.variants[1].options.variants.count("surface"), 0u);
  EXPECT_EQ(study.variants[5].options.variants.at("surface"), "poisson");
  EXPECT_EQ(study.variants[5].options.values.count("fuse"), 0u);
  EXPECT_EQ(attribution_of(pipeline_b(), pipeline_a()).stages, study.stages);
  EXPECT_THROW(attribution_of(pipeline_b(), pipeline_b()), InputError);
}

// fuse is worth 0.1, surface 0.2, both together 0.05 more; fit nothing.
double known_score(const ReconstructionOptions& options) {
  const bool fuse = options.values.count("fuse") > 0;
  const auto surface = options.variants.find("surface");
  const bool swapped = surface != options.variants.end() && surface->second == "poisson";
  return 0.5 + 0.1 * fuse + 0.2 * swapped + 0.05 * (fuse && swapped);
}

// Four drawn scenes, the last of which fails for B.
StudyResults known_results(const std::string& name, const AttributionStudy& swaps) {
  const fs::path folder = fs::path(testing::TempDir()) / ("attribution_" + name);
  fs::remove_all(folder);
  Study study;
  study.name = "A to B";
  study.variants = swaps.variants;
  study.baseline = "A";
  study.metrics = {study_metric("test", "surface <slot>/f_5mm@1")};
  study.drawn.push_back({{}, 1, 4});
  const StudyPlan plan = plan_study(study, "# of a test\n", folder);
  const Signature signature{{"code", "one"}};
  run_cells(plan, {folder, {}, signature}, [&](const StudyPlan&, const PlannedCell& cell, const fs::path&) {
    const StudyVariant& variant = plan.study.variants[cell.variant];
    if (variant.name == "B" && cell.scene == 3) throw InputError("out", "no clothes");
    MadeCell made;
    made.result = {cell.id, signature, plan.scenes[cell.scene].name, cell.seed, 1, false, "", {}, {}};
    made.result.scores = {{"surface", "top/f_5mm@1", "1", known_score(variant.options) + 0.01 * cell.scene, "ok", 10}};
    return made;
  });
  return read_results(folder);
}

TEST(Attribution, PartsAreThoseThatWerePutIn) {
  const AttributionStudy swaps = attribution_of(pipeline_a(), pipeline_b());
  const StudyResults results = known_results("parts", swaps);
  const auto all = attributions(results, swaps.stages);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].scenes.size(), 3u);
  EXPECT_EQ(all[0].planned_scenes, 4u);
  ASSERT_EQ(all[0].parts.size(), 3u);
  EXPECT_NEAR(all[0].parts[0].from_first, 0.10, 1e-12);
  EXPECT_NEAR(all[0].parts[0].from_last, 0.15, 1e-12);  // the surface is there by then
  EXPECT_NEAR(all[0].parts[1].from_first, 0.25, 1e-12);
  EXPECT_NEAR(all[0].parts[1].from_last, 0.20, 1e-12);
  EXPECT_NEAR(all[0].parts[2].from_first, 0, 1e-12);
  double first = 0, last = 0;
  for (const auto& part : all[0].parts) first += part.from_first, last += part.from_last;
  EXPECT_NEAR(first, all[0].b - all[0].a, 1e-12);
  EXPECT_NEAR(last, all[0].b - all[0].a, 1e-12);
  const std::string text = attribution_markdown(results, all);
  EXPECT_NE(text.find("A 0.510, B 0.860: +0.350 over 3 of 4 scenes."), std::string::npos) << text;
  EXPECT_NE(text.find("| fuse | +0.100 (+0.100 to +0.100) | +0.150 (+0.150 to +0.150) | +0.125 |"), std::string::npos)
      << text;
  const std::string csv = attribution_csv(all);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3 * 3 * 2);
}

TEST(Attribution, OtherStudiesAreRefused) {
  const AttributionStudy swaps = attribution_of(pipeline_a(), pipeline_b());
  const StudyResults results = known_results("other", swaps);
  EXPECT_THROW(attributions(results, {"fuse", "surface", "fit", "correct"}), InputError);
}

}  // namespace
}  // namespace dressform
