#include "eval/wardrobe/dressing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>

#include "eval/wardrobe/sizes.h"
#include "eval/wardrobe/wardrobe_picture.h"
#include "pipeline/testing/figure.h"
#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

// A shirt and a skirt of tubes on the figure of capsules, the shirt over the skirt.
CapturedClothes tubes_on_a_figure() {
  CapturedClothes clothes;
  clothes.name = "tubes";
  clothes.naked = known_body(make_figure({}));
  clothes.garments.garments["top"] = make_tube(0.185, 0.98, 1.25);
  clothes.garments.garments["bottom"] = make_tube(0.175, 0.60, 1.06);
  clothes.layouts["top"].kind = "shirt";
  clothes.layouts["top"].worn = Worn::over;
  clothes.layouts["bottom"].kind = "skirt";
  clothes.layouts["bottom"].worn = Worn::under;
  return clothes;
}

double score(const Dressed& dressed, const std::string& slot, const std::string& metric) {
  for (const DressedScore& each : dressed.scores)
    if (each.slot == slot && each.metric == metric) return each.value;
  ADD_FAILURE() << "no " << slot << " " << metric;
  return 1e9;
}

TEST(Dressed, AWiderBodyWearsBothLayersWithTheEaseTheyWereCutWith) {
  const CapturedClothes clothes = tubes_on_a_figure();
  const KnownBody body = known_body(make_figure({1.75, 1.1, 15, 0}));
  const Dressed on_body = dressed(clothes, body);
  ASSERT_EQ(on_body.garments.size(), 2u);
  EXPECT_EQ(score(on_body, "top", "intersecting_pairs"), 0);
  EXPECT_EQ(score(on_body, "bottom", "intersecting_pairs"), 0);
  EXPECT_EQ(score(on_body, "bottom/top", "intersecting_pairs"), 0);
  EXPECT_NEAR(score(on_body, "top", "ease_chest_change"), 0, 25);
  for (const auto& [slot, garment] : on_body.garments)
    EXPECT_EQ(garment.mesh.triangles, clothes.garments.garments.at(slot).mesh.triangles);

  const cv::Mat picture = wardrobe_picture({{{&body, &on_body, "tubes"}, {}}}, 200);
  EXPECT_EQ(picture.cols, 2 * 116);
  EXPECT_LT(cv::mean(picture(cv::Rect(0, 0, 116, 200)))[0], cv::mean(picture(cv::Rect(116, 0, 116, 200)))[0]);
}

TEST(BestSizes, TheOneWhoseEaseIsNearestToWhatWasMeant) {
  const std::vector<SizeEase> eases{{"S", "top", "chest", 0, 20, 60},  {"S", "top", "waist", 0, 70, 90},
                                    {"M", "top", "chest", 0, 70, 60},  {"M", "top", "waist", 0, 110, 90},
                                    {"L", "top", "chest", 0, 80, 60},  {"L", "top", "waist", 0, 80, 90},
                                    {"S", "bottom", "hip", 0, 30, 30}, {"M", "bottom", "hip", 0, 70, 30}};
  const auto best = best_sizes(eases);
  EXPECT_EQ(best.at("top"), "M");  // 15 off, as L: the smaller
  EXPECT_EQ(best.at("bottom"), "S");
  EXPECT_TRUE(best_sizes({}).empty());
}

TEST(Customer, WhatIsNoBodyIsNamed) {
  const fs::path folder = fs::path(testing::TempDir()) / "no_run";
  fs::create_directories(folder);
  const auto refused = [](const fs::path& source) -> std::string {
    try {
      customer_of(source, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "was taken";
  };
  EXPECT_THAT(refused(folder), testing::HasSubstr("run.json"));
  EXPECT_THAT(refused(folder / "nobody.ply"), testing::HasSubstr("nobody.ply"));
  std::ofstream(folder / "open.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_THAT(refused(folder / "open.obj"), testing::HasSubstr("expected a closed body"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace dressform
