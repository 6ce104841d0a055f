#include "eval/gate/power/planted_store.h"

#include <gtest/gtest.h>

namespace dressform {
namespace {

namespace fs = std::filesystem;

class PlantedStore : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(root_);
    ArtifactStore store(root_ / "store");
    for (const auto* label : {"fuse_naked", "segment"}) {
      StageRecord record;
      record.label = label;
      record.recipe = {label, "default", "code", {}, 1, {"input"}};
      record.content_hash = store.save(record.recipe, std::string("bytes of ") + label, 1, 2).content_hash;
      records_.push_back(record);
    }
  }
  void TearDown() override { fs::remove_all(root_); }

  static std::string bytes_in(const fs::path& store, const Recipe& recipe) {
    const ArtifactStore opened(store);
    return opened.load(opened.find(recipe).value());
  }

  fs::path root_ = fs::path(testing::TempDir()) / "planted_store";
  std::vector<StageRecord> records_;
};

TEST_F(PlantedStore, OneArtifactHasOtherBytesUnderItsKeyAndTheOthersAreThere) {
  plant_artifact(
      root_ / "store", records_, "segment", [](const std::string& bytes) { return bytes + "!"; }, root_ / "planted");
  EXPECT_EQ(bytes_in(root_ / "planted", records_[0].recipe), "bytes of fuse_naked");
  EXPECT_EQ(bytes_in(root_ / "planted", records_[1].recipe), "bytes of segment!");
  const ArtifactStore planted(root_ / "planted");
  EXPECT_EQ(planted.find(records_[0].recipe)->content_hash, records_[0].content_hash);
  EXPECT_NE(planted.find(records_[1].recipe)->content_hash, records_[1].content_hash);
}

TEST_F(PlantedStore, TheRunsOwnStoreStaysAsItIsEvenWhenThePlantedOneGoes) {
  plant_artifact(
      root_ / "store", records_, "segment", [](const std::string&) { return std::string("x"); }, root_ / "planted");
  fs::remove_all(root_ / "planted");
  for (const auto& record : records_) EXPECT_EQ(bytes_in(root_ / "store", record.recipe), "bytes of " + record.label);
}

TEST_F(PlantedStore, StagesThatAreNotThereAreAnError) {
  const auto same = [](const std::string& bytes) { return bytes; };
  EXPECT_THROW(plant_artifact(root_ / "store", records_, "fit", same, root_ / "planted"), std::logic_error);
  fs::remove_all(root_ / "store" / "segment");
  EXPECT_THROW(plant_artifact(root_ / "store", records_, "fuse_naked", same, root_ / "other"), std::runtime_error);
}

}  // namespace
}  // namespace dressform
