#include "eval/cli/option_fields.h"

#include <gtest/gtest.h>

namespace dressform {
namespace {

struct SampleParams {
  std::string kind = "a", any_text;
  double width_m = 1;
  int count = 2;
  bool really = false;
};
template <class V>
void fields(V& v, SampleParams& p) {
  v("kind", p.kind, {"a", "b"}, "one of two");
  v("any_text", p.any_text, {}, "any");
  v("width_m", p.width_m, 0.5, 2.0, "m", "how wide");
  v("count", p.count, 1, 9, "", "how many");
  v("really", p.really, "whether");
}

// Whether the command takes the words; `params` gets what they say.
bool takes(SampleParams& params, std::vector<std::string> words) {
  CLI::App command;
  OptionFields options(command);
  fields(options, params);
  std::reverse(words.begin(), words.end());  // as CLI11 takes a vector
  try {
    command.parse(words);
    return true;
  } catch (const CLI::ParseError&) {
    return false;
  }
}

TEST(OptionFields, EveryKindOfField) {
  SampleParams params;
  EXPECT_TRUE(takes(params, {"--kind", "b", "--any-text", "x y", "--width-m", "0.75", "--count", "3", "--really"}));
  EXPECT_EQ(params.kind, "b");
  EXPECT_EQ(params.any_text, "x y");
  EXPECT_EQ(params.width_m, 0.75);
  EXPECT_EQ(params.count, 3);
  EXPECT_TRUE(params.really);
}

TEST(OptionFields, RangesAndWordsHold) {
  SampleParams params;
  EXPECT_FALSE(takes(params, {"--kind", "c"}));
  EXPECT_FALSE(takes(params, {"--width-m", "3"}));
  EXPECT_FALSE(takes(params, {"--count", "0"}));
  EXPECT_FALSE(takes(params, {"--width_m", "1"}));
}

}  // namespace
}  // namespace dressform
