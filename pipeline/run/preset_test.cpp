#include "pipeline/run/preset.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "pipeline/reconstruct.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

class Presets : public testing::Test {
 protected:
  void TearDown() override { fs::remove(file_); }
  Preset read(const std::string& text) const {
    std::ofstream(file_) << text;
    return read_preset(file_.string());
  }
  void expect_refused(const std::string& text, const std::string& at, const std::string& why) const {
    SCOPED_TRACE(text);
    try {
      read(text);
      ADD_FAILURE() << "was read";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("mine.toml" + at));
      EXPECT_THAT(error.what(), HasSubstr(why));
    }
  }
  const fs::path file_ = fs::path(testing::TempDir()) / "mine.toml";
};

// A preset that names a variant which is not there, or a value that it does not take, is found here.
TEST_F(Presets, ThoseOfTheProgramAreWhole) {
  EXPECT_THAT(preset_names(), Contains("default"));
  EXPECT_THAT(preset_names(), Contains("thesis"));
  for (const auto& name : preset_names()) {
    const Preset preset = read_preset(name);
    EXPECT_EQ(preset.name, name);
    EXPECT_FALSE(preset.description.empty());
    ReconstructionOptions options;
    options.variants = preset.variants;
    options.values = preset.values;
    EXPECT_NO_THROW(check_options(options)) << name;
  }
  EXPECT_THAT(read_preset("default").variants, IsEmpty());
  EXPECT_THAT(read_preset("default").values, IsEmpty());
}

TEST_F(Presets, ReadsVariantsAndValues) {
  const Preset preset = read(R"(description = "mine"
[variants]
correct = "thesis_centroid"
[set]
correct.gap_m = 0.004
fuse.voxel_m = 0.005
)");
  EXPECT_EQ(preset.name, "mine");
  EXPECT_EQ(preset.description, "mine");
  EXPECT_EQ(preset.variants, (std::map<std::string, std::string>{{"correct", "thesis_centroid"}}));
  EXPECT_EQ(preset.values,
            (std::map<std::string, FieldValues>{{"correct", {{"gap_m", 0.004}}}, {"fuse", {{"voxel_m", 0.005}}}}));
}

TEST_F(Presets, WhatIsNotKnownIsNamed) {
  expect_refused("[variants]\nfusion = \"pose_graph\"\n", ":2:1", "unknown key \"fusion\"");
  expect_refused("[variants]\nfuse = \"magic\"\n", ":2:", "pose_graph");
  expect_refused("[set]\nfuse.voxels = 3\n", ":2:", "voxel_m");
  expect_refused("[set]\nfuse.voxel_m = 3.0\n", ":2:", "voxel_m: found 3");
  expect_refused("[set]\nfuse.voxel_m = \"small\"\n", ":2:", "expected a number");
  expect_refused("[set]\nfuse = 3\n", ":2:", "expected a table");
  expect_refused("varients = 1\n", ":1:1", "unknown key");
  expect_refused("[variants\n", ":1:", "");
  try {
    read_preset("theses");
    ADD_FAILURE() << "was read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--preset theses"));
    for (const auto& name : preset_names()) EXPECT_THAT(error.what(), HasSubstr(name));
  }
  EXPECT_THROW(read_preset("no/such/file.toml"), InputError);
}

}  // namespace
}  // namespace dressform
