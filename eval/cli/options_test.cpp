#include "eval/cli/options.h"

#include <gtest/gtest.h>

#include <fstream>

namespace dressform {
namespace {

namespace fs = std::filesystem;

// A preset of one's own, and what the command line makes of it.
class PresetOptions : public testing::Test {
 protected:
  void SetUp() override {
    options_.preset = (fs::path(testing::TempDir()) / "mine.toml").string();
    std::ofstream(options_.preset) << "[variants]\nfill = \"random31\"\ncorrect = \"thesis_centroid\"\n"
                                      "[set]\nfill.block_px = 15\ncorrect.gap_m = 0.004\n";
  }
  void TearDown() override { fs::remove(options_.preset); }
  CommonOptions options_;
};

TEST_F(PresetOptions, StandForVariantsAndValues) {
  const auto chosen = parse_choices(options_).reconstruction;
  EXPECT_EQ(chosen.variants.at("fill"), "random31");
  EXPECT_EQ(std::get<int>(chosen.values.at("fill").at("block_px")), 15);
  EXPECT_EQ(variant_text(options_), "mine");
  EXPECT_NO_THROW(check_options(chosen));
}

TEST_F(PresetOptions, AreOverriddenByTheCommandLine) {
  options_.variants = {"fill=reproject", "correct=thesis_centroid"};
  options_.values = {"correct.gap_m=0.005"};
  const auto chosen = parse_choices(options_).reconstruction;
  EXPECT_EQ(chosen.variants.at("fill"), "reproject");
  EXPECT_EQ(chosen.values.count("fill"), 0u) << "the preset's block is not reproject's";
  EXPECT_EQ(std::get<std::string>(chosen.values.at("correct").at("gap_m")), "0.005");
  EXPECT_EQ(variant_text(options_), "mine correct.gap_m=0.005 correct=thesis_centroid fill=reproject");
  EXPECT_NO_THROW(check_options(chosen));
}

TEST_F(PresetOptions, TheDefaultOneIsNoChoice) {
  options_.preset = "default";
  EXPECT_EQ(variant_text(options_), "default");
  EXPECT_TRUE(parse_choices(options_).reconstruction.variants.empty());
}

}  // namespace
}  // namespace dressform
