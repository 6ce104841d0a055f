#include "eval/report/csv.h"

#include <gtest/gtest.h>

namespace dressform {
namespace {

TEST(Csv, OnlyWhatWouldPartAFieldIsQuoted) {
  EXPECT_EQ(csv_field("top f_5mm@1"), "top f_5mm@1");
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("a, b"), "\"a, b\"");
  EXPECT_EQ(csv_field("the \"top\""), "\"the \"\"top\"\"\"");
  EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(csv_field("two\rlines"), "\"two\rlines\"");
}

}  // namespace
}  // namespace dressform
