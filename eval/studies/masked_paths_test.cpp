#include "eval/studies/masked_paths.h"

#include <gtest/gtest.h>

namespace dressform {
namespace {

TEST(MaskedPaths, WholePathsAndWhatLiesBelowThem) {
  EXPECT_EQ(with_masked_paths("/a/b/out: bad, see /a/b.", {{"/a/b", "<run>"}}), "<run>/out: bad, see <run>.");
  EXPECT_EQ(with_masked_paths("/a/bc: bad", {{"/a/b", "<run>"}}), "/a/bc: bad");
  EXPECT_EQ(with_masked_paths("/x/a/b: bad", {{"a/b", "<run>"}}), "/x/a/b: bad");
  EXPECT_EQ(with_masked_paths("\"/a/b\"", {{"/a/b/", "<run>"}}), "\"<run>\"");
}

TEST(MaskedPaths, FirstOnesFirst) {
  EXPECT_EQ(with_masked_paths("./work/1: ./scenes/a.toml", {{"./work/1", "<run>"}, {".", "<study>"}}),
            "<run>: <study>/scenes/a.toml");
}

// Looking again from where the word begins would never end.
TEST(MaskedPaths, AWordThatHoldsThePathIsNotSearchedAgain) {
  EXPECT_EQ(with_masked_paths("study/cells: bad", {{"study", "<study>"}}), "<study>/cells: bad");
  EXPECT_EQ(with_masked_paths("run run", {{"run", "<run> run"}}), "<run> run <run> run");
  EXPECT_EQ(with_masked_paths("has no clothes", {{"", "<study>"}}), "has no clothes");
}

}  // namespace
}  // namespace dressform
