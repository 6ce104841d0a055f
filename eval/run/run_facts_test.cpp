#include "eval/run/run_facts.h"

#include <gtest/gtest.h>

#include <fstream>

#include "scenes/error.h"

namespace dressform {
namespace {

namespace fs = std::filesystem;

class RunFactsFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const std::string& text) const { std::ofstream(folder_ / "run.json") << text; }
  const fs::path folder_ = fs::path(testing::TempDir()) / "run_facts";
};

TEST_F(RunFactsFile, AreWhatTheRunWrote) {
  write(R"({"scene": "group1", "variant": "thesis", "seed": 7, "scale": 0.5, "session": {"path": "/a/session"},
            "provenance": {"commit": "abc", "threads": 2}})");
  const RunFacts facts = read_run_facts(folder_);
  EXPECT_EQ(facts.scene, "group1");
  EXPECT_EQ(facts.variant, "thesis");
  EXPECT_EQ(facts.seed, 7u);
  EXPECT_EQ(facts.scale, 0.5);
  EXPECT_EQ(facts.session, "/a/session");
  EXPECT_EQ(facts.commit, "abc");
}

TEST_F(RunFactsFile, WhatIsNotSaidIsAbsent) {
  for (const char* text : {"", "{}", R"({"scale": null})"}) {
    if (*text) write(text);  // first: no such file
    const RunFacts facts = read_run_facts(folder_);
    EXPECT_FALSE(facts.scene || facts.variant || facts.seed || facts.scale);
    EXPECT_TRUE(facts.session.empty() && facts.commit.empty());
  }
}

TEST_F(RunFactsFile, DamageIsNamed) {
  for (const char* text : {"{", "[]", R"({"scene": 3})", R"({"session": "/a"})", R"({"scale": "half"})"}) {
    write(text);
    EXPECT_THROW(read_run_facts(folder_), InputError) << text;
  }
}

}  // namespace
}  // namespace dressform
