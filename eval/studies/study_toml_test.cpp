#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "eval/studies/study.h"
#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

const fs::path kLibrary = fs::path(DRESSFORM_SOURCE_DIR) / "scenes/library";

const std::string kTop = "name = \"a\"\nscale = 0.4\nseeds = [1, 2]\n";
const std::string kScenes = "[scenes]\n[[scenes.drawn]]\ncount = 3\nstrata = [\"skirt\"]\n";
const std::string kPrimary = "[[primary]]\nmetric = \"surface <slot>/f_5mm@1\"\nmargin = 0.01\n";
const std::string kTwo = "[[variant]]\nname = \"default\"\n[[variant]]\nsensor = \"ideal\"\n";

Study read_text(const std::string& text) {
  const fs::path file = fs::path(testing::TempDir()) / "study_to_read.toml";
  std::ofstream(file) << text;
  return read_study(file);
}

std::string error_of(const std::string& text) {
  try {
    read_text(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::vector<std::string> names_of(const Study& study) {
  std::vector<std::string> names;
  for (const auto& variant : study.variants) names.push_back(variant.name);
  return names;
}

TEST(StudyToml, WhatIsAskedForIsThere) {
  const Study study = read_text(kTop + "secondary = [\"registration max/tre_mm@1\"]\n" + kScenes + kPrimary + kTwo);
  EXPECT_EQ(study.name, "a");
  EXPECT_EQ(study.scale, 0.4);
  EXPECT_EQ(study.seeds, (std::vector<Seed>{1, 2}));
  ASSERT_EQ(study.drawn.size(), 1u);
  EXPECT_EQ(study.drawn[0].count, 3);
  EXPECT_EQ(study.drawn[0].options.strata, (std::vector<std::string>{"skirt"}));
  ASSERT_EQ(study.metrics.size(), 2u);
  EXPECT_TRUE(study.metrics[0].primary);
  EXPECT_EQ(study.metrics[0].margin, 0.01);
  EXPECT_FALSE(study.metrics[1].primary);
  EXPECT_EQ(study.baseline, "default");
  EXPECT_EQ(names_of(study), (std::vector<std::string>{"default", "sensor=ideal"}));
  EXPECT_EQ(study.variants[1].sensor.variant, "ideal");
}

TEST(StudyToml, ArraysAreGrids) {
  const Study study = read_text(kTop + kScenes + kPrimary +
                                "[[variant]]\n[[variant]]\nname = \"fusion\"\nset.fuse.voxel_m = [0.003, 0.004]\n"
                                "scale = [0.3, 0.6]\nstages = {surface = \"layer\"}\n");
  EXPECT_EQ(
      names_of(study),
      (std::vector<std::string>{"default", "fusion fuse.voxel_m=0.003 scale=0.3", "fusion fuse.voxel_m=0.004 scale=0.3",
                                "fusion fuse.voxel_m=0.003 scale=0.6", "fusion fuse.voxel_m=0.004 scale=0.6"}));
  EXPECT_EQ(std::get<double>(study.variants[2].options.values.at("fuse").at("voxel_m")), 0.004);
  EXPECT_EQ(study.variants[4].scale, 0.6);
  EXPECT_EQ(study.variants[4].options.variants.at("surface"), "layer");
}

TEST(StudyToml, OneAtATimeIsTheRegistry) {
  const Study study = read_text(kTop + kScenes + kPrimary + "[[variant]]\none_at_a_time = true\n");
  std::size_t others = 0;
  const auto names = names_of(study);
  for (const auto& stage : describe_stages())
    for (const auto& variant : stage.variants) {
      const bool there = std::find(names.begin(), names.end(), stage.name + "=" + variant.name) != names.end();
      EXPECT_EQ(there, variant.name != stage.default_variant && variant.picks.empty()) << stage.name << variant.name;
      others += there;
    }
  EXPECT_GT(others, 5u);
  EXPECT_EQ(study.variants.size(), others + 1);
  const Study some = read_text(kTop + kScenes + kPrimary + "[[variant]]\none_at_a_time = true\nof = [\"surface\"]\n");
  for (std::size_t v = 1; v < some.variants.size(); ++v) EXPECT_EQ(some.variants[v].name.rfind("surface=", 0), 0u);
}

TEST(StudyToml, ATableMayBeAFileOfItsOwn) {
  std::ofstream(fs::path(testing::TempDir()) / "fine.toml") << "name = \"fine\"\n[set.fuse]\nvoxel_m = 0.003\n";
  const Study study =
      read_text(kTop + kScenes + kPrimary + "[[variant]]\n[[variant]]\nfile = \"fine.toml\"\nsensor = \"ideal\"\n");
  EXPECT_EQ(study.variants[1].name, "fine");
  EXPECT_EQ(study.variants[1].options.values.count("fuse"), 1u);
  EXPECT_EQ(study.variants[1].sensor.variant, "ideal");
}

TEST(StudyToml, PresetsAreVariants) {
  std::ofstream(fs::path(testing::TempDir()) / "my_preset.toml")
      << "description = \"mine\"\n[variants]\nfill = \"thesis_random31\"\n";
  const Study study = read_text(kTop + kScenes + kPrimary +
                                "[[variant]]\nevery_preset = true\n[[variant]]\npreset = \"my_preset.toml\"\n");
  const auto names = names_of(study);
  EXPECT_EQ(names.front(), "default");
  EXPECT_EQ(names.back(), "my_preset");
  EXPECT_NE(std::find(names.begin(), names.end(), "thesis"), names.end());
  EXPECT_EQ(study.variants.back().options.variants.at("fill"), "thesis_random31");
}

TEST(StudyToml, AnotherVariantTakesNothingOfThePreset) {
  std::ofstream(fs::path(testing::TempDir()) / "set_preset.toml")
      << "[variants]\nfill = \"random31\"\ncorrect = \"thesis_centroid\"\n"
         "[set]\nfill.block_px = 15\ncorrect.gap_m = 0.004\n";
  const Study study = read_text(kTop + kScenes + kPrimary +
                                "[[variant]]\n[[variant]]\npreset = \"set_preset.toml\"\n"
                                "stages = {fill = \"reproject\", correct = \"thesis_centroid\"}\n");
  const auto& options = study.variants[1].options;
  EXPECT_EQ(options.variants.at("fill"), "reproject");
  EXPECT_EQ(options.values.count("fill"), 0u) << "the preset's block is not reproject's";
  EXPECT_EQ(std::get<double>(options.values.at("correct").at("gap_m")), 0.004);
  EXPECT_NO_THROW(check_options(options));
}

TEST(StudyToml, ParametersOfASensorAreThoseOfTheOneBeside) {
  const std::string set = "set.sensor.noise_scale = 2.0\n", none = kScenes + kPrimary + "[[variant]]\n[[variant]]\n";
  const Study study = read_text(none + "sensor = \"fankhauser\"\n" + set);
  EXPECT_EQ(study.variants[1].sensor.variant, "fankhauser");
  EXPECT_EQ(std::get<double>(study.variants[1].sensor.values.at("noise_scale")), 2.0);
  EXPECT_NE(error_of(none + set).find("set.sensor.noise_scale: found no sensor model beside it"), std::string::npos);
}

TEST(StudyToml, EveryStudyOfTheLibraryCanBeRead) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(kLibrary / "studies")) {
    SCOPED_TRACE(entry.path());
    const Study study = read_study(entry.path());
    EXPECT_GE(study.drawn.at(0).count, 12);
    ++count;
  }
  EXPECT_GE(count, 4);
}

TEST(StudyToml, OraclesAreVariants) {
  const std::string start = kTop + kScenes + kPrimary + "[[variant]]\nname = \"default\"\n[[variant]]\n";
  const Study one = read_text(start + "oracle = [\"registration\", \"open\"]\nset.fuse.voxel_m = 0.003\n");
  ASSERT_EQ(one.variants.size(), 3u);
  EXPECT_EQ(one.variants[2].oracles, (std::vector<std::string>{"open"}));
  EXPECT_EQ(one.variants[2].options.values.count("fuse"), 1u);
  const Study all = read_text(start + "every_oracle = true\n");
  const auto names = names_of(all);
  EXPECT_NE(std::find(names.begin(), names.end(), "oracle.fuse_naked"), names.end());
  EXPECT_GE(names.size(), 10u);
  EXPECT_NE(error_of(start + "oracle = \"fit\"\n").find("truth cannot stand in for; expected one of calibrate"),
            std::string::npos);
}

// Each names the line, and what would be right.
TEST(StudyToml, MistakesAreNamed) {
  const auto expect = [](const std::string& text, const std::string& line, const std::string& words) {
    const std::string error = error_of(text);
    EXPECT_NE(error.find("study_to_read.toml:" + line + ":"), std::string::npos) << error;
    EXPECT_NE(error.find(words), std::string::npos) << error;
  };
  expect("name = 3\n", "1", "expected text");
  expect("nam = \"a\"\n" + kScenes + kPrimary + kTwo, "1", "unknown key \"nam\"");
  expect(kTop + kPrimary + kTwo, "1", "found no [scenes]");
  expect("seeds = [1, 1]\n" + kScenes + kPrimary + kTwo, "1", "different whole numbers");
  expect(kScenes + "[[primary]]\nmetric = \"surface <slot>/f_5mm@1\"\n" + kTwo, "5", "no margin");
  expect(kScenes + "[[primary]]\nmetric = \"surface <slot>/f_5mm@9\"\nmargin = 1\n" + kTwo, "6", "not declared");
  expect(kScenes + "[[primary]]\nmetric = \"surfaces <slot>/f_5mm@1\"\nmargin = 1\n" + kTwo, "6", "a stage of");
  expect(kScenes + "[[primary]]\nmetric = \"open <slot>/euler@1\"\nmargin = 1\n" + kTwo, "6", "no better and worse");
  expect(kScenes + kPrimary + "[[variant]]\n[[variant]]\nstages = {surfaces = \"a\"}\n", "10", "expected one of");
  expect(kScenes + kPrimary + "[[variant]]\n[[variant]]\nstages = {surface = \"a\"}\n", "10", "expected one of");
  expect(kScenes + kPrimary + "[[variant]]\n[[variant]]\nset.fuse.voxel = 1\n", "10", "known are");
  expect(kScenes + kPrimary + "[[variant]]\n[[variant]]\nset.fuse.voxel_m = 40\n", "10", "expected 0.00");
  expect(kScenes + kPrimary + "[[variant]]\n[[variant]]\nset.fuse.voxel_m = \"4\"\n", "10", "a number");
  expect(kScenes + kPrimary + "[[variant]]\n[[variant]]\nsensor = \"kinect_v9\"\n", "10", "expected one of");
  expect(kScenes + kPrimary + "[[variant]]\n[[variant]]\nrig = \"no.toml\"\n", "10", "expected a file");
  expect("baseline = \"x\"\n" + kScenes + kPrimary + kTwo, "1", "expected one of default, sensor=ideal");
  expect(kScenes + kPrimary + "[[variant]]\n[[variant]]\n", "9", "twice");
  expect("[scenes]\nfiles = [\"no.toml\"]\n" + kPrimary + kTwo, "2", "expected a file");
  expect("[scenes]\n" + kPrimary + kTwo, "1", "found no scenes");
  EXPECT_NE(error_of(kScenes + kPrimary + kPrimary + kTwo).find("twice"), std::string::npos);
  EXPECT_NE(error_of(kScenes + kTwo).find("found 0 primary"), std::string::npos);
  EXPECT_NE(error_of(kScenes + kPrimary + "[[variant]]\n").find("two at least"), std::string::npos);
}

}  // namespace
}  // namespace dressform
