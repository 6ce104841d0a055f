#include "scenes/length_units.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dressform {
namespace {

TEST(LengthUnits, AreWhatTheyAre) {
  EXPECT_EQ(metres_in("m"), 1);
  EXPECT_EQ(metres_in("mm"), 0.001);
  EXPECT_NEAR(12 * metres_in("inch"), metres_in("foot"), 1e-15);
  EXPECT_STREQ(length_unit("cm").plural, "centimetres");
}

TEST(LengthUnits, OthersAreNamed) {
  try {
    metres_in("yard");
    FAIL() << "expected an InputError";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("unit: found \"yard\"; expected one of m, dm, cm, mm, inch, foot"));
  }
}

}  // namespace
}  // namespace dressform
