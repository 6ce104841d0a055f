#include "eval/gate/junit.h"

#include <gtest/gtest.h>

#include <pugixml.hpp>

namespace dressform {
namespace {

CheckedCase some_check() {
  CheckedCase checked{"group1", {}, ""};
  checked.result.items = {{"surface", "top/f_5mm@1", ItemVerdict::worse, "reference 0.9 < \"0.8\" & so on", 5},
                          {"open", "top/loops@1", ItemVerdict::same, "", 0},
                          {"image", "result_user", ItemVerdict::better, "lighter", 2}};
  checked.result.findings = {checked.result.items[0]};
  return checked;
}

TEST(GateJunit, OneTestANumberAndOneForTheBytes) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(junit_xml({some_check()}).c_str()));
  const auto suite = document.child("testsuites").child("testsuite");
  EXPECT_STREQ(suite.attribute("name").value(), "gate.group1");
  EXPECT_EQ(suite.attribute("tests").as_int(), 4);
  EXPECT_EQ(suite.attribute("failures").as_int(), 1);
  int tests = 0, failures = 0;
  for (const auto& test : suite.children("testcase")) {
    ++tests;
    EXPECT_STREQ(test.attribute("classname").value(), "gate.group1");
    if (!test.child("failure")) continue;
    ++failures;
    EXPECT_STREQ(test.attribute("name").value(), "surface.top/f_5mm@1");
    EXPECT_STREQ(test.child("failure").attribute("message").value(), "reference 0.9 < \"0.8\" & so on");
  }
  EXPECT_EQ(tests, 4);
  EXPECT_EQ(failures, 1);
}

TEST(GateJunit, ACaseWithoutResultIsAnError) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(junit_xml({{"group2", {}, "golden.json: missing"}}).c_str()));
  const auto suite = document.child("testsuites").child("testsuite");
  EXPECT_EQ(suite.attribute("errors").as_int(), 1);
  EXPECT_STREQ(suite.child("testcase").child("error").attribute("message").value(), "golden.json: missing");
}

}  // namespace
}  // namespace dressform
