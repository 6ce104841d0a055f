#include "eval/gate/bytes.h"

#include <gtest/gtest.h>

namespace dressform {
namespace {

using Steps = std::vector<StepBytes>;
const Environment kHere{{"compiler", "GNU 12"}}, kThere{{"compiler", "Clang 14"}};
const Steps kThen{{"capture", "c", "scene"}, {"fuse_naked", "f", "c"}, {"segment", "s", "c f"}, {"scores", "n", "s"}};

TEST(GateBytes, EqualBytesAreIdenticalWhateverTheEnvironment) {
  EXPECT_EQ(compare_bytes(kThen, kHere, kThen, kHere).state, BytesState::identical);
  const auto elsewhere = compare_bytes(kThen, kHere, kThen, kThere);
  EXPECT_EQ(elsewhere.state, BytesState::identical);
  EXPECT_EQ(elsewhere.environment, "compiler GNU 12 -> Clang 14");
}

TEST(GateBytes, TheFirstStageThatChangedOnTheSameInputsIsToBlame) {
  const Steps now{{"capture", "c", "scene"}, {"fuse_naked", "F", "c"}, {"segment", "S", "c F"}, {"scores", "N", "S"}};
  const auto result = compare_bytes(kThen, kHere, now, kHere);
  EXPECT_EQ(result.state, BytesState::changed);
  EXPECT_EQ(result.changed, (std::vector<std::string>{"fuse_naked", "segment", "scores"}));
  EXPECT_EQ(result.origins, std::vector<std::string>{"fuse_naked"});
  EXPECT_NE(bytes_text(result).find("first at fuse_naked"), std::string::npos);
}

TEST(GateBytes, TwoIndependentChangesAreBothNamed) {
  const Steps now{{"capture", "c", "scene"}, {"fuse_naked", "f", "c"}, {"segment", "S", "c f"}, {"scores", "N", "s"}};
  EXPECT_EQ(compare_bytes(kThen, kHere, now, kHere).origins, (std::vector<std::string>{"segment", "scores"}));
}

TEST(GateBytes, OtherParametersAreBlamedOnTheStageThatWasAskedOtherwise) {
  const Steps now{
      {"capture", "c", "scene"}, {"fuse_naked", "F", "c fine"}, {"segment", "S", "c F"}, {"scores", "N", "S"}};
  EXPECT_EQ(compare_bytes(kThen, kHere, now, kHere).origins, std::vector<std::string>{"fuse_naked"});
}

TEST(GateBytes, NewAndMissingStepsAreChanges) {
  Steps fewer = kThen;
  fewer.pop_back();
  EXPECT_EQ(compare_bytes(kThen, kHere, fewer, kHere).origins, std::vector<std::string>{"scores"});
  EXPECT_EQ(compare_bytes(fewer, kHere, kThen, kHere).origins, std::vector<std::string>{"scores"});
}

TEST(GateBytes, AnotherEnvironmentExplainsOtherBytesAndOldGoldensKeptNone) {
  const Steps now{{"capture", "c", "scene"}, {"fuse_naked", "F", "c"}, {"segment", "S", "c F"}, {"scores", "N", "S"}};
  EXPECT_EQ(compare_bytes(kThen, kHere, now, kThere).state, BytesState::other_environment);
  const auto none = compare_bytes({}, {}, now, kHere);
  EXPECT_EQ(none.state, BytesState::none_kept);
  EXPECT_EQ(bytes_text(none), "no bytes kept: accept to keep them");
}

}  // namespace
}  // namespace dressform
