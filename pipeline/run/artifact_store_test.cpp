#include "pipeline/run/artifact_store.h"

#include <gtest/gtest.h>

#include <fstream>

#include "pipeline/run/place_folder.h"
#include "pipeline/run/stage_runner.h"
#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

class StoreTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("store_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  Recipe recipe() const { return {"fuse", "tsdf", "v1", {{"voxel_m", 0.004}}, 7, {"aa", "bb"}}; }
  fs::path folder_;
};

TEST_F(StoreTest, KeyDependsOnEverythingThatGoesIn) {
  const auto key = recipe().key();
  std::vector<Recipe> others(6, recipe());
  others[0].stage = "fill";
  others[1].variant = "other";
  others[2].code_version = "v2";
  others[3].values["voxel_m"] = 0.0040000000000000001 + 1e-17 + 1e-6;
  others[4].seed = 8;
  others[5].inputs = {"bb", "aa"};
  for (const auto& other : others) EXPECT_NE(other.key(), key);
  EXPECT_EQ(recipe().key(), key);
}

TEST_F(StoreTest, FindsWhatWasSavedAndNothingElse) {
  ArtifactStore store(folder_);
  EXPECT_FALSE(store.find(recipe()));
  store.save(recipe(), "the bytes", 1.5, 20);
  const auto found = store.find(recipe());
  ASSERT_TRUE(found);
  EXPECT_EQ(store.load(*found), "the bytes");
  EXPECT_EQ(found->seconds, 1.5);
  auto other = recipe();
  other.seed = 9;
  EXPECT_FALSE(store.find(other));
}

TEST_F(StoreTest, DamagedAndTruncatedArtifactsAreNotFoundAndCanBeMadeAgain) {
  ArtifactStore store(folder_);
  const fs::path at = store.folder(recipe());
  store.save(recipe(), "the bytes", 0, 0);
  fs::resize_file(at / "data.bin", 4);
  EXPECT_FALSE(store.find(recipe()));
  store.save(recipe(), "the bytes", 0, 0);
  std::ofstream(at / "data.bin") << "the bites";
  EXPECT_FALSE(store.find(recipe()));
  store.save(recipe(), "the bytes", 0, 0);
  fs::resize_file(at / "artifact.json", 10);
  EXPECT_FALSE(store.find(recipe()));
  store.save(recipe(), "the bytes", 0, 0);
  fs::remove(at / "data.bin");
  EXPECT_FALSE(store.find(recipe()));
  store.save(recipe(), "the bytes", 0, 0);
  EXPECT_TRUE(store.find(recipe()));
}

// Two processes make one artifact at the same time: whoever comes second leaves the first one's in peace.
TEST_F(StoreTest, WhatAnotherProcessMadeMeanwhileStays) {
  ArtifactStore store(folder_);
  place_folder(
      store.folder(recipe()),
      [&](const fs::path& mine) {
        std::ofstream(mine / "who") << "mine";
        ArtifactStore(folder_).save(recipe(), "the bytes", 0, 0);  // faster
      },
      [&] { return store.find(recipe()).has_value(); });
  EXPECT_TRUE(store.find(recipe()));
  EXPECT_FALSE(fs::exists(store.folder(recipe()) / "who"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "fuse"), fs::directory_iterator()), 1);
}

TEST_F(StoreTest, NothingIsLeftOfWhatCouldNotBeWritten) {
  ArtifactStore store(folder_);
  EXPECT_THROW(place_folder(
                   store.folder(recipe()),
                   [&](const fs::path& folder) {
                     std::ofstream(folder / "half") << "x";
                     throw InputError("data.bin", "cannot be written");
                   },
                   [] { return false; }),
               InputError);
  EXPECT_TRUE(fs::is_empty(folder_ / "fuse"));
}

TEST_F(StoreTest, AnArtifactUnderAnothersNameIsNotFound) {
  ArtifactStore store(folder_);
  store.save(recipe(), "the bytes", 0, 0);
  Recipe other = recipe();
  other.code_version = "v0";  // another version's store
  fs::create_directories(store.folder(other).parent_path());
  fs::rename(store.folder(recipe()), store.folder(other));
  EXPECT_FALSE(store.find(other));
  EXPECT_FALSE(store.find(recipe()));
}

TEST_F(StoreTest, LeavesNoTemporaryFiles) {
  ArtifactStore store(folder_);
  store.save(recipe(), std::string(1000, 'x'), 0, 0);
  for (const auto& entry : fs::recursive_directory_iterator(folder_))
    EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos) << entry.path();
}

// A little stage of its own, to watch the pipeline run it.
struct DoubleTag {
  static constexpr const char* name = "fuse";  // any stage with a code version
  static constexpr const char* default_variant = "twice";
};
struct Number {
  double value = 0;
  template <class Archive>
  void serialize(Archive& archive) {
    archive(value);
  }
};
using Double = Stage<DoubleTag, Number(const Number&)>;
int calls = 0;
struct TwiceParams {
  double factor = 2;
};
template <class V>
void fields(V& v, TwiceParams& p) {
  v("factor", p.factor, 0.0, 10.0, "", "multiplied by this");
}
Number twice(const Number& input, const TwiceParams& params) {
  ++calls;
  return {input.value * params.factor};
}
const Double::Variant twice_variant{"twice", twice};

TEST_F(StoreTest, RunnerRunsAStageOnceAndOnlyAgainWhenSomethingChanged) {
  ArtifactStore store(folder_);
  const LazyArtifact<Number> input("hash of three", [] { return Number{3}; });
  calls = 0;
  ReconstructionOptions options;
  EXPECT_EQ(StageRunner(options, store, {}).run<Double>("double", input).get().value, 6);
  EXPECT_EQ(StageRunner(options, store, {}).run<Double>("double", input).get().value, 6);
  EXPECT_EQ(calls, 1);
  options.values["fuse"]["factor"] = std::string("5");  // text, as from the command line
  EXPECT_EQ(StageRunner(options, store, {}).run<Double>("double", input).get().value, 15);
  options.values["fuse"]["factor"] = 5.0;
  EXPECT_EQ(StageRunner(options, store, {}).run<Double>("double", input).get().value, 15);
  EXPECT_EQ(calls, 2);
  options.values["fuse"]["factor"] = 50.0;
  EXPECT_THROW(StageRunner(options, store, {}).run<Double>("double", input), InputError);
  options.values["fuse"] = {{"fcator", 5.0}};
  EXPECT_THROW(StageRunner(options, store, {}).run<Double>("double", input), InputError);
}

TEST_F(StoreTest, AGivenResultStandsInForItsStage) {
  ArtifactStore store(folder_);
  const LazyArtifact<Number> input("hash of three", [] { return Number{3}; });
  const ReconstructionOptions options;
  GivenArtifacts given;
  given.give<Double>("first", {100});
  calls = 0;
  StageRunner runner(options, store, {}, given);
  const auto first = runner.run<Double>("first", input);
  EXPECT_EQ(first.get().value, 100);
  EXPECT_EQ(calls, 0);
  EXPECT_EQ(runner.run<Double>("second", first).get().value, 200);  // those that follow go by it
  EXPECT_EQ(runner.records().front().recipe.variant, "given");
  EXPECT_FALSE(runner.records().front().reused);
  EXPECT_EQ(StageRunner(options, store, {}, given).run<Double>("first", input).content_hash(), first.content_hash());
  EXPECT_EQ(StageRunner(options, store, {}).run<Double>("first", input).get().value, 6);  // and no other run
}

TEST(Options, UnknownStagesVariantsAndParametersAreNamed) {
  ReconstructionOptions options;
  options.variants["fuze"] = "tsdf";
  EXPECT_THROW(check_options(options), InputError);
}

}  // namespace
}  // namespace dressform
