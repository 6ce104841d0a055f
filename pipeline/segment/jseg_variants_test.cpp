#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "pipeline/segment/jseg_naming.h"
#include "pipeline/segment/segment.h"
#include "pipeline/testing/analytic_scene.h"
#include "scenes/picks.h"

namespace dressform {
namespace {

using analytic::AnalyticScene;
using analytic::label_iou;

const AnalyticScene& scene() {
  static const AnalyticScene made = analytic::make_scene();
  return made;
}

// What an operator who knows the truth labels.
Picks labelled(const AnalyticScene& of) {
  Picks picks;
  for (const auto& [sensor, truth] : of.labels)
    for (const auto& [name, label] : {std::pair("skin", 1), std::pair("top", 2), std::pair("bottom", 3)})
      picks.regions[std::string("label_") + name + "_" + sensor] = truth == label;
  return picks;
}

Segmentation named(const Picks& picks) {
  const auto extracted = Extract::at("cluster").run(scene().session, scene().calibration, scene().naked, {}, 1);
  return Segment::at("jseg").run_with_picks(scene().session, scene().calibration, scene().body, extracted,
                                            scene().registration, {}, picks, 1);
}

TEST(JsegNamed, RegionsTakeTheOperatorsLabels) {
  const Segmentation found = named(labelled(scene()));
  for (const auto& [sensor, truth] : scene().labels)
    for (const int label : {1, 2, 3})
      EXPECT_GT(label_iou(found.labels.at(sensor), truth, label), 0.85) << sensor << label;
  EXPECT_EQ(found.garments.at("top").kind, "shirt");
  EXPECT_EQ(found.garments.at("bottom").kind, "trousers");
  EXPECT_TRUE(found.garments.at("top").arms[0].covered);
}

TEST(JsegNamed, WhatLiesOutsideTheOperatorsRegionIsAnArtefact) {
  Picks picks = labelled(scene());
  const cv::Mat truth = scene().labels.at("k1");
  cv::Mat left_half = cv::Mat::zeros(truth.size(), CV_8U);
  left_half.colRange(0, truth.cols / 2).setTo(255);
  picks.regions["region_top_k1"] = left_half;
  const Segmentation found = named(picks);
  EXPECT_EQ(cv::countNonZero((found.labels.at("k1") == 2) & ~left_half), 0);
  EXPECT_GT(cv::countNonZero((found.labels.at("k1") == 2) & left_half), 300);
  EXPECT_GT(cv::countNonZero((found.labels.at("k1") == 3) & ~left_half), 300) << "the other garment stays";
}

TEST(JsegNamed, SaysWhichLabelsAreMissingOrOfAnotherSize) {
  Picks picks = labelled(scene());
  picks.regions["label_top_k2"] = cv::Mat::zeros(7, 9, CV_8U);
  EXPECT_THAT([&] { named(picks); }, testing::ThrowsMessage<InputError>(testing::HasSubstr("label_top_k2: is 9 x 7")));
  for (const char* name : {"label_skin_k2", "label_top_k2", "label_bottom_k2"}) picks.regions.erase(name);
  EXPECT_THAT([&] { named(picks); }, testing::ThrowsMessage<InputError>(testing::HasSubstr("label_*_k2")));
}

// Regions as region_facts would describe them, seen by one view, each `beside` the one before it.
class RegionNames : public testing::Test {
 protected:
  void add(double height_m, double offset_mm, const cv::Vec3d& luv, double area_mm2 = 50000) {
    RegionFacts region;
    region.label = static_cast<int>(regions_.size()) + 1;
    region.area_mm2 = area_mm2, region.height_m = height_m, region.offset_mm = offset_mm;
    region.unchanged = offset_mm < 8 ? 1 : 0;
    region.color.add(luv, area_mm2);
    if (const int before = static_cast<int>(regions_.size()) - 1; before >= 0) {
      region.beside[before] = 20;
      regions_[before].beside[before + 1] = 20;
    }
    regions_.push_back(region);
  }
  std::vector<Label> names() const {
    Landmarks limbs;
    limbs.hip_y = 0.9;
    return region_names(regions_, limbs, {});
  }
  std::vector<RegionFacts> regions_;
};

const cv::Vec3d kSkinColor(75, 10, 20), kRed(40, 90, 20), kBlue(30, -10, -60);

TEST_F(RegionNames, ByBodyColourAndHeight) {
  add(1.6, 1, kSkinColor);
  add(1.2, 20, kRed);
  add(0.5, 12, kBlue);
  add(0.1, 2, kSkinColor);
  EXPECT_THAT(names(), testing::ElementsAre(Label::skin, Label::top, Label::bottom, Label::skin));
}

// Less than half of a shirt hangs below the hips, in a piece of its own.
TEST_F(RegionNames, ClothesOfOneColourThatTouchAreOne) {
  add(1.25, 20, kRed, 90000);
  add(0.85, 20, kRed + cv::Vec3d(6, 2, 0), 30000);
  add(0.5, 12, kBlue);
  EXPECT_THAT(names(), testing::ElementsAre(Label::top, Label::top, Label::bottom));
}

TEST_F(RegionNames, SmallPiecesByThemselvesAreArtefacts) {
  add(1.2, 20, kRed, 90000);
  add(0.5, 12, kBlue, 90000);
  add(0.7, 2, kSkinColor, 200);
  EXPECT_THAT(names(), testing::ElementsAre(Label::top, Label::bottom, Label::bottom));
}

TEST_F(RegionNames, SliversAtAJumpOfDepthAreArtefacts) {
  add(1.2, 20, kRed, 90000);
  add(1.2, 2, kSkinColor, 200);
  add(1.5, 2, kSkinColor, 90000);
  regions_[1].fringe = 0.9;
  regions_[1].beside[0] = 60;
  EXPECT_EQ(names()[1], Label::top);
}

TEST_F(RegionNames, HardlyAnyClothIsNoGarment) {
  add(1.6, 1, kSkinColor, 90000);
  add(1.2, 20, kRed, 90000);
  add(0.8, 20, kBlue, 3000);
  EXPECT_THAT(names(), testing::ElementsAre(Label::skin, Label::top, Label::top));
}

}  // namespace
}  // namespace dressform
