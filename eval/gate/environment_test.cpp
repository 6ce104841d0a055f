#include "eval/gate/environment.h"

#include <gtest/gtest.h>

namespace dressform {
namespace {

TEST(GateEnvironment, NamesCompilerLibrariesAndRenderer) {
  const Environment here = this_environment();
  for (const char* name : {"compiler", "flags", "glibc", "opencv", "eigen", "embree", "renderer", "instructions"})
    EXPECT_EQ(here.count(name), 1u) << name;
  EXPECT_NE(here.at("renderer").find("Mesa"), std::string::npos) << here.at("renderer");
  EXPECT_EQ(environment_difference(here, this_environment()), "");
}

TEST(GateEnvironment, OnlyInstructionSetsThatLibrariesChooseByCount) {
  EXPECT_EQ(instruction_sets(" fpu vme fma sse2 avx2 avx hypervisor"), "avx avx2 fma");
  EXPECT_EQ(instruction_sets("fpu"), "");
}

TEST(GateEnvironment, ADifferenceNamesWhatDiffers) {
  EXPECT_EQ(
      environment_difference({{"compiler", "GNU 12"}, {"flags", "-O2"}}, {{"compiler", "Clang 14"}, {"flags", "-O2"}}),
      "compiler GNU 12 -> Clang 14");
  EXPECT_EQ(environment_difference({}, {{"GLIBC_TUNABLES", "x"}}), "GLIBC_TUNABLES none -> x");
}

}  // namespace
}  // namespace dressform
